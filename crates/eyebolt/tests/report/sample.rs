//! Outcomes to make pages of.

use crate::run::{Ran, WITHOUT_MASKS, run_depth};
use crate::scene::shots;
use eyebolt::answer::Answer;
use eyebolt::calibrate::{Calibration, Reason, Verdict};
use eyebolt::joint_limits::OutsideLimits;
use eyebolt::pipeline::Outcome;
use eyebolt::report::{Context, TruthComparison, html, overlays};
use eyebolt_robot::JointKind;
use std::sync::LazyLock;

/// A trusted calibration of which one configuration was dropped.
pub static GOOD: LazyLock<Ran> = LazyLock::new(|| {
    let mut frames = shots();
    // The elbow was elsewhere when the joints were read.
    frames[2].joints[2] += 0.5;
    run_depth(&frames, WITHOUT_MASKS)
});

/// Its page.
pub static PAGE: LazyLock<String> = LazyLock::new(|| page(&GOOD.answer, &GOOD.outcome));

/// A page with pictures and a comparison.
pub fn page(answer: &Answer, outcome: &Outcome) -> String {
    let pictures: Vec<_> = overlays(outcome, |_| None).collect();
    let truth = Some(TruthComparison { translation_mm: 0.123, rotation_deg: 0.0456 });
    html(
        answer,
        outcome,
        &Context {
            recording: "bags/monday.mcap",
            pictures: &pictures,
            truth,
            ..Context::default()
        },
    )
}

/// `ran` as it would be if it had been refused for `reasons`.
pub fn refused(ran: &Ran, reasons: Vec<Reason>) -> (Answer, Outcome) {
    let (mut answer, mut outcome) = (ran.answer.clone(), ran.outcome.clone());
    answer.verdict = "refused";
    answer.reasons = reasons.iter().map(ToString::to_string).collect();
    outcome.calibration.verdict = Verdict::Refused(reasons);
    (answer, outcome)
}

/// As [`refused`], without a pose and without anything that a pose is needed for.
pub fn without_pose(ran: &Ran, reasons: Vec<Reason>) -> (Answer, Outcome) {
    let (mut answer, mut outcome) = refused(ran, reasons);
    outcome.calibration = Calibration::without_pose(outcome.calibration.verdict.clone());
    outcome.observations = None;
    answer.configurations.clear();
    answer.joint_offsets.clear();
    (answer.camera_from_base, answer.base_from_camera) = (None, None);
    (answer.expected_error, answer.workspace_in_base_m) = (None, None);
    (answer.leave_one_out, answer.disagreement, answer.covariance) = (None, None, None);
    (answer.contradicted_share, answer.unexplained_share) = (None, None);
    (answer.depth_scale_error, answer.outline_excess_px) = (None, None);
    (answer.image_source, answer.intrinsics, answer.optical_from_image) = (None, None, None);
    (answer, outcome)
}

/// One of each kind.
pub fn all_reasons() -> Vec<Reason> {
    let outside = OutsideLimits {
        joint: "elbow".to_owned(),
        frame: "3".to_owned(),
        position: 4.5,
        lower: -2.0,
        upper: 2.0,
        kind: JointKind::Revolute,
    };
    vec![
        Reason::FewConfigurations { used: 2, needed: 3 },
        Reason::DepthUnit { unit_m: 0.001, fitting_m: 0.0001 },
        Reason::NothingFound,
        Reason::OtherRobot { problem: "no joint called a & b".to_owned() },
        Reason::OutOfView,
        Reason::Underdetermined,
        Reason::NotSettled { translation_mm: 3.5, rotation_deg: 0.25 },
        Reason::OutsideLimits(outside),
        Reason::Misplaced { misplaced: 3, judged: 5 },
        Reason::JointOff { joint: "elbow".to_owned(), offset_deg: -3.5, limit_deg: 2.0 },
        Reason::Contradicted { percent: 40.0, limit: 25.0 },
        Reason::JointsExchanged { joints: ["elbow".to_owned(), "wrist".to_owned()] },
        Reason::Ambiguous,
        Reason::Inaccurate {
            translation_mm: 33.0,
            rotation_deg: 2.5,
            limit_mm: 10.0,
            limit_deg: 0.6,
        },
    ]
}

/// `text` as it stands in HTML.
pub fn escaped(text: &str) -> String {
    let plain = [('&', "&amp;"), ('<', "&lt;"), ('>', "&gt;"), ('"', "&quot;")];
    let pairs = plain.into_iter().chain([('\'', "&#x27;"), ('/', "&#x2f;")]);
    pairs.fold(text.to_owned(), |text, (plain, entity)| text.replace(plain, entity))
}
