//! What to do about what is not as it should be.

use super::form::Info;
use eyebolt_recording::{DepthChoice, FrameSource, counted};
use eyebolt_robot::{Input, joint_prefix};

/// Fewer configurations are refused; and as many make a good answer.
const FEWEST: usize = 3;
const ENOUGH: usize = 5;
/// Below this share of pixels with depth, little of an arm is seen.
const LITTLE_DEPTH: f64 = 0.3;
/// Depth cameras see from here to there, metres.
const PLAUSIBLE_M: (f64, f64) = (0.1, 12.0);
/// Delays between depth and joints beyond this are worth a word, seconds.
const LATE_S: f64 = 0.15;
/// Stamps nearer than this are as good as one clock's, seconds.
const SAME_S: f64 = 0.05;

/// How the advice begins where no robot is known.
pub const NO_ROBOT: &str = "no robot is known";

/// Sentences, and whether nothing of what they say is in the way of a calibration.
struct Advice {
    ready: bool,
    lines: Vec<String>,
}

impl Advice {
    /// What makes a better recording.
    fn add(&mut self, line: String) {
        self.lines.push(line);
    }

    /// What a calibration needs.
    fn need(&mut self, line: String) {
        self.ready = false;
        self.lines.push(line);
    }
}

/// Whether `source` can be calibrated, and sentences, the most important first.
pub(super) fn advice(info: &Info, source: &dyn FrameSource) -> (bool, Vec<String>) {
    let mut advice = Advice { ready: true, lines: Vec::new() };
    topic(info, source, &mut advice);
    robot(info, &mut advice);
    configurations(info, &mut advice);
    depth(info, &mut advice);
    clock(info, &mut advice);
    if !info.damage.is_empty() {
        advice.add(format!(
            "{} of the bag damaged: what was there is lost to this recording",
            match info.damage.len() {
                1 => "a part is".to_owned(),
                count => format!("{count} parts are"),
            }
        ));
    }
    (advice.ready, advice.lines)
}

/// Says which of several topics of depth this is, and which to name.
fn topic(info: &Info, source: &dyn FrameSource, advice: &mut Advice) {
    let Some(choice) = source.provenance().depth_choice else { return };
    let taken = info.topics.iter().find(|topic| topic.role == Some("depth"));
    let taken = taken.map_or("the first", |topic| topic.name.as_str());
    let why = match choice {
        DepthChoice::Raw => "the others were made of what it has",
        DepthChoice::First => "or another: they seem to be of several cameras",
    };
    advice.need(format!(
        "several topics have depth, and this is of {taken}: give {} {taken}; {why}",
        Input::DEPTH_TOPIC
    ));
}

fn robot(info: &Info, advice: &mut Advice) {
    let Some(robot) = &info.robot else {
        advice.need(format!("{NO_ROBOT}: give {}, or record /robot_description", Input::ROBOT));
        return;
    };
    if !robot.missing_joints.is_empty() {
        let one = robot.missing_joints.len() == 1;
        let prefix = joint_prefix(&robot.missing_joints, &info.joints);
        let prefix = prefix.map_or(String::new(), |prefix| {
            format!("; their names differ by `{prefix}`: give {} {prefix}", Input::JOINT_PREFIX)
        });
        advice.need(format!(
            "{} {} of the arm {} not recorded: record {}, or give the URDF of the robot that was \
             recorded{prefix}",
            if one { "joint" } else { "joints" },
            robot.missing_joints.join(", "),
            if one { "is" } else { "are" },
            if one { "its states" } else { "these joint states" },
        ));
    }
    for untold in &robot.untold_joints {
        let (frames, all) = (counted(untold.frames, "frame"), untold.frames >= info.frames.used);
        let line = format!("{frames} cannot be used: {}", untold.reason);
        if all { advice.need(line) } else { advice.add(line) }
    }
    for outside in &robot.outside_limits {
        advice.need(outside.to_string());
    }
    if !robot.unplaced_joints.is_empty() {
        let one = robot.unplaced_joints.len() == 1;
        advice.add(format!(
            "{} {} outside the arm's chain {} not recorded: {} links take no part, unless {} says where {}",
            if one { "joint" } else { "joints" },
            robot.unplaced_joints.join(", "),
            if one { "is" } else { "are" },
            if one { "its" } else { "their" },
            Input::JOINT,
            if one { "it stands" } else { "they stand" },
        ));
    }
}

fn configurations(info: &Info, advice: &mut Advice) {
    let count = info.configurations.len();
    if count < FEWEST {
        let (configurations, are) = (
            counted(count, "arm configuration"),
            if count == 1 { "is too few" } else { "are too few" },
        );
        advice.need(format!(
            "{configurations} {are}: record at least {FEWEST}, better {ENOUGH} or more, far apart, \
             the arm at rest in each"
        ));
    } else if count < ENOUGH {
        advice.add(format!("{count} arm configurations will do; {ENOUGH} or more are better"));
    }
    let dropped: usize = info.frames.dropped.values().sum();
    let moving = info.frames.dropped.get("moving").copied().unwrap_or(0);
    if moving > 0 && 10 * moving > 9 * (dropped + info.frames.used) {
        advice.add(
            "the arm moves in nearly all frames: let it rest for a second or two in every \
             configuration"
                .to_owned(),
        );
    }
    let stale = info.frames.dropped.get("no_joint_state_near").copied().unwrap_or(0);
    if stale > 0 {
        advice.add(format!(
            "no joint state is near {}: record joint states all the time, and let both computers \
             keep the same time",
            counted(stale, "frame")
        ));
    }
}

fn depth(info: &Info, advice: &mut Advice) {
    let depth = &info.depth;
    if depth.share_valid < LITTLE_DEPTH {
        advice.add(format!(
            "only {:.0} % of the pixels have depth: check exposure, distance and the depth mode",
            100.0 * depth.share_valid
        ));
    }
    let [near, _, far] = depth.range_m.unwrap_or_default();
    if depth.range_m.is_some() && (far < PLAUSIBLE_M.0 || near > PLAUSIBLE_M.1) {
        advice.need(format!(
            "depth lies between {near:.3} and {far:.3} m, which no camera before an arm sees: \
             say what one of its numbers is with {}",
            Input::DEPTH_UNIT
        ));
    }
}

fn clock(info: &Info, advice: &mut Advice) {
    let Some(clock) = info.clock else { return };
    let apart_s = clock.offset_s.abs();
    if clock.applied && apart_s > clock.uncertainty_s.max(SAME_S) {
        let how = if clock.seen_in_motion {
            "by the motion in both"
        } else {
            "by the times of recording"
        };
        advice.add(format!(
            "stamps of depth and joints are {apart_s:.3} s apart {how}, which was made up for to \
             {:.3} s: stamp both by one clock",
            clock.uncertainty_s
        ));
    } else if !clock.applied && apart_s > LATE_S {
        let later = if clock.offset_s > 0.0 { "depth" } else { "joint states" };
        advice.add(format!(
            "{later} came {apart_s:.2} s later after their stamps than the other: frames near motion \
             are left out; synchronise the clocks if they are of two computers"
        ));
    }
}
