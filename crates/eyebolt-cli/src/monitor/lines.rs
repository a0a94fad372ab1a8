//! What a person reads of what is watched.

use crate::output::emphasised;
use eyebolt::monitor::{Drift, Moved, Suspect, ViewReport, WhyNot};

/// One view.
pub fn view(report: &ViewReport) -> String {
    let ViewReport { frame, residual_mm, .. } = report;
    let residual = residual_mm.map_or_else(String::new, |mm| format!(", residual {mm:.1} mm"));
    let state = match report.why_not {
        Some(WhyNot::Unplaced) => "does not count: a joint has no position".to_owned(),
        Some(WhyNot::TellsNothing) => "does not count: too little of the arm is seen".to_owned(),
        Some(WhyNot::SeenBefore) => "does not count: as when the arm last rested there".to_owned(),
        None => report.drift.as_ref().map_or_else(String::new, drift),
    };
    let evidence = match report.log10_evidence {
        Some(log10) => format!(", evidence 10^{log10:.1} of the limit"),
        None => String::new(),
    };
    let alarm =
        if report.alarm { format!("  {}", emphasised("ALARM", false)) } else { String::new() };
    format!("{frame}: {state}{residual}{evidence}{alarm}")
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

/// What moved, likeliest first.
pub fn suspects(report: &ViewReport) -> String {
    let found = report.moved.iter().take(3).map(suspect).collect::<Vec<_>>().join("; ");
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
