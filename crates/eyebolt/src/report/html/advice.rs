//! What to do about a refusal, and what to know of an answer.

use crate::answer::Answer;
use crate::calibrate::Reason;

/// What to do about `reason`, the likeliest cause first; inputs are called arguments, and what is shown
/// in a report is `below`. The reason's own sentence names the cause.
pub fn remedies(reason: &Reason) -> &'static [&'static str] {
    match reason {
        Reason::FewConfigurations { .. } => &[
            "Record five configurations or more, each with the arm at rest for a second or two.",
            "Move several joints by tens of degrees between them; frames with the arm in the same place \
             count once.",
            "See below which configurations were dropped, and why.",
        ],
        Reason::DepthUnit { .. } => &[
            "Give the unit with argument `depth_unit`, or set depth_unit in recording.toml, and calibrate again.",
            "The driver's documentation says what one is (depth scale, depth units).",
        ],
        Reason::NothingFound => &[
            "Check with `eyebolt info` that the frames have depth where the arm is.",
            "Check that the robot description, with its tool, is the one of this arm.",
            "Move the arm farther between configurations, or record masks of it: what never moves \
             cannot be told from the room.",
        ],
        Reason::OtherRobot { .. } => &[
            "Give the description of the robot that was recorded: argument `robot`.",
            "If joints have other names in the recording, rename them where they are published or in \
             recording.toml.",
        ],
        Reason::OutOfView => &[
            "Turn the camera so that most of the arm is in view in every configuration.",
            "Look at the depth images: an arm nearer than the camera's least distance, or black and \
             shiny, has no depth.",
        ],
        Reason::Underdetermined => &[
            "Record configurations that differ in several joints, the arm near and far, left and right.",
            "See that more than one link is in view.",
        ],
        Reason::NotSettled { .. } => &[
            "Record more configurations, or nearer to the camera.",
            "Look at the pictures below for something beside the arm that is taken for it.",
        ],
        Reason::OutsideLimits(_) => &[
            "Compare one recorded joint state with the robot's display: names, order, sign, unit.",
            "If the arm was really there, correct the limits in the URDF.",
        ],
        Reason::Misplaced { .. } => &[
            "See in the pictures below which link is beside the arm seen: joints before it are right, \
             the joint that moves it, or its zero, is not.",
            "Check that joint states and depth were taken at the same time: the arm at rest, clocks in step.",
        ],
        Reason::JointOff { .. } => &[
            "Compare one recorded joint state with the robot's display: names, order, sign, unit.",
            "If the joint really is that far off, set its zero anew: nothing that rests on it is right.",
        ],
        Reason::BaseElsewhere { .. } => &[
            "Give the description of the variant that was recorded: arms of one series share the names of their \
             joints, and their bases differ.",
            "See in the pictures below whether the base stands where it is drawn; what it stands on is none of it.",
        ],
        Reason::JointsExchanged { .. } => &[
            "Compare one recorded joint state with the robot's display: names, order, sign, unit.",
            "In recording.toml, give `joint_names` in the order in which the positions are stored.",
        ],
        Reason::Contradicted { .. } => &[
            "Check that the robot description has the variant, the mount and the tool of this arm.",
            "Check joint names and order, and that depth is in the unit that the recording says.",
        ],
        Reason::Ambiguous => &[
            "Bend the arm: a stretched or upright arm looks alike from many sides.",
            "Record configurations with the wrist turned to different sides.",
        ],
        Reason::Inaccurate { .. } => &[
            "Record more configurations, spread over the workspace, nearer to the camera.",
            "See below which source the error comes from; if surfaces and outlines disagree, check the \
             intrinsics and the depth's scale.",
            "If this is accurate enough for the task, say so: argument `max_error_translation`, argument `max_error_rotation`.",
        ],
    }
}

/// `finding` with a capital letter and a full stop.
fn sentence(finding: String) -> String {
    let mut letters = finding.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string()).unwrap_or_default();
    format!("{first}{}.", letters.as_str())
}

/// What a careful reader should know of an answer, trusted or not.
pub(super) fn notes(answer: &Answer) -> Vec<String> {
    let mut notes = Vec::new();
    if answer.camera_from_base.is_some() {
        evidence(answer, &mut notes);
    }
    if !answer.unplaced_joints.is_empty() {
        notes.push(format!(
            "Joints that were not recorded: {}. The links that they move took no part.",
            answer.unplaced_joints.join(", ")
        ));
    }
    notes.extend(answer.left_out.iter().cloned().map(sentence));
    if !answer.frames.guessed.is_empty() {
        notes.push(format!(
            "Nobody named base and end-effector both; guessed: {}.",
            answer.frames.guessed.join(", ").replace('_', "-")
        ));
    }
    notes.extend(answer.findings().into_iter().map(sentence));
    if answer.background == Some("of_another_scene") {
        notes.push(
            "The frames without the arm show another scene, or this one from another place: they were \
             not used. Record them again with the camera where it is now."
                .to_owned(),
        );
    }
    if let Some(seconds) = answer.clock_offset_s {
        notes.push(format!(
            "The clocks of depth and joints were {seconds:.3} s apart; stamps of depth were shifted by \
             that much."
        ));
    }
    if answer.frames.camera.is_none() {
        notes.push(
            "The recording does not name the camera's frame: it is the optical frame of the depth."
                .to_owned(),
        );
    }
    if answer.image_source == Some("drawn_clouds") {
        notes.push(
            "Clouds came without a camera and were drawn as a made-up one sees them: give the \
             intrinsics for a better answer."
                .to_owned(),
        );
    }
    notes
}

/// A depth scale that is off by more than this is worth a look at the camera.
const NOTABLE_SCALE: f64 = 0.01;
/// Likewise of the outline's excess, pixels.
const NOTABLE_EXCESS_PX: f64 = 2.0;

fn evidence(answer: &Answer, notes: &mut Vec<String>) {
    let mut note = |text: String| notes.push(text);
    if answer.disagreement.is_none() {
        note(
            "No outline of the arm was seen: the answer rests on surfaces alone, and the expected error \
             has an allowance for that."
                .to_owned(),
        );
    }
    if answer.leave_one_out.is_none() {
        note(
            "With fewer than three configurations, nothing tells how much the answer hangs on one of \
             them."
                .to_owned(),
        );
    }
    if let Some(scale) = answer.depth_scale_error.filter(|scale| scale.abs() > NOTABLE_SCALE) {
        note(format!(
            "Depth fits best when scaled by {:+.1} %: check the camera's depth calibration and unit.",
            100.0 * scale
        ));
    }
    for joint in answer.notable_joint_offsets() {
        note(format!(
            "{} seems to stand {:+.2} ± {:.2} degrees from where it says: check its zero, and that the \
             robot description is this arm's. The answer allows for it.",
            joint.joint, joint.offset_deg, joint.sigma_deg
        ));
    }
    let any_notable = answer.notable_joint_offsets().next().is_some();
    if let Some(mm) = answer.end_effector_off_by_joints_mm.filter(|_| any_notable) {
        note(format!(
            "Unless the joints' zeros are corrected, the end-effector is up to {mm:.1} mm from where they \
             put it, whatever the calibration."
        ));
    }
    if let Some(px) = answer.outline_excess_px.filter(|px| px.abs() > NOTABLE_EXCESS_PX) {
        note(format!(
            "The outline seen is {:.1} pixels {} than the arm's on each side: masks, or depth at edges, \
             are drawn that way.",
            px.abs(),
            if px > 0.0 { "wider" } else { "narrower" }
        ));
    }
}
