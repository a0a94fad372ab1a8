//! What a person reads of what is watched.

use crate::output::emphasised;
use eyebolt::monitor::{Drift, Moved, Suspect, ViewReport, WhyNot};

/// One view.
pub fn view(report: &ViewReport) -> String {
    let state = match report.why_not {
        Some(WhyNot::Unplaced) => Some("does not count: a joint has no position".to_owned()),
        Some(WhyNot::TellsNothing) => {
            Some("does not count: too little of the arm is seen".to_owned())
        }
        Some(WhyNot::SeenBefore) => {
            Some("does not count: as when the arm last rested there".to_owned())
        }
        None => report.drift.as_ref().map(drift),
    };
    let residual = report.residual_mm.map(|mm| format!("residual {mm:.1} mm"));
    let evidence = report.log10_evidence;
    let evidence = evidence.map(|log10| format!("evidence 10^{log10:.1} of the limit"));
    let told: Vec<String> = [state, residual, evidence].into_iter().flatten().collect();
    let alarm =
        if report.alarm { format!("  {}", emphasised("ALARM", false)) } else { String::new() };
    format!("{}: {}{alarm}", report.frame, told.join(", "))
}

fn drift(drift: &Drift) -> String {
    format!(
        "drift {:.1} +- {:.1} mm, {:.2} +- {:.2} deg over {} views",
        drift.translation_mm,
        drift.translation_sigma_mm,
        drift.rotation_deg,
        drift.rotation_sigma_deg,
        drift.views
    )
}

/// All of them.
pub fn ending(last: Option<&ViewReport>, views: usize, counted: usize) -> String {
    let count = format!("{views} views, {counted} of them counted");
    let Some(last) = last.filter(|last| last.alarm) else {
        let word = if counted == 0 {
            emphasised("unknown", false)
        } else {
            emphasised("still true", true)
        };
        return format!("{word}: {count}");
    };
    let mut text = format!(
        "{}: {count}\nwhat moved: {}",
        emphasised("something moved", false),
        suspects(last)
    );
    if let Some(pose) = &last.proposed_camera_from_base {
        let [x, y, z] = pose.translation_m;
        let [qx, qy, qz, qw] = pose.rotation_xyzw;
        text += &format!(
            "\nproposed, and not applied: camera_from_base = [{x:.4}, {y:.4}, {z:.4}] m, xyzw [{qx:.5}, {qy:.5}, \
             {qz:.5}, {qw:.5}]. Calibrate again to have it with its error"
        );
    }
    text
}

/// Who is suspected less is not named.
const HARDLY: f64 = 0.01;

/// What moved, likeliest first.
pub fn suspects(report: &ViewReport) -> String {
    let likely = report.moved.iter().take(3).filter(|moved| moved.probability >= HARDLY);
    let found = likely.map(suspect).collect::<Vec<_>>().join("; ");
    if found.is_empty() { "cannot be told".to_owned() } else { found }
}

fn suspect(moved: &Moved) -> String {
    let what = match &moved.what {
        Suspect::CameraOrBase => "the camera or the base".to_owned(),
        Suspect::Camera => "the camera".to_owned(),
        Suspect::Base => "the base".to_owned(),
        Suspect::JointZero(joint) => {
            let by = moved.joint_deg.map_or_else(String::new, |deg| format!(" by {deg:.2} deg"));
            format!("the zero of {joint}{by}")
        }
    };
    format!("{what} ({:.0} %)", 100.0 * moved.probability)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Of a view that counts, and in which nothing moved.
    pub fn report() -> ViewReport {
        ViewReport {
            frame: "7".to_owned(),
            counts: true,
            why_not: None,
            residual_mm: Some(2.0),
            expected_residual_mm: None,
            seen_through_share: 0.0,
            surprise: None,
            log10_evidence: Some(-3.0),
            alarm: false,
            drift: None,
            moved: Vec::new(),
            proposed_camera_from_base: None,
        }
    }

    #[test]
    fn only_what_is_known_is_told() {
        let mut report = report();
        assert_eq!(view(&report), "7: residual 2.0 mm, evidence 10^-3.0 of the limit");
        report.why_not = Some(WhyNot::TellsNothing);
        (report.residual_mm, report.log10_evidence) = (None, None);
        assert_eq!(view(&report), "7: does not count: too little of the arm is seen");
        assert_eq!(suspects(&report), "cannot be told");
        let suspect = |probability| Moved { what: Suspect::Camera, probability, joint_deg: None };
        report.moved = vec![suspect(0.997), suspect(0.003)];
        assert_eq!(suspects(&report), "the camera (100 %)");
    }
}
