//! What to do about what is not as it should be.

use super::form::Info;
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

/// Sentences, the most important first.
pub(super) fn advice(info: &Info) -> Vec<String> {
    let mut advice = Vec::new();
    robot(info, &mut advice);
    configurations(info, &mut advice);
    depth(info, &mut advice);
    clock(info, &mut advice);
    if !info.damage.is_empty() {
        advice.push(format!(
            "{} parts of the bag are damaged: what they held is lost to this recording",
            info.damage.len()
        ));
    }
    advice
}

fn robot(info: &Info, advice: &mut Vec<String>) {
    let Some(robot) = &info.robot else {
        advice.push(format!("{NO_ROBOT}: give {}, or record /robot_description", Input::ROBOT));
        return;
    };
    if !robot.missing_joints.is_empty() {
        let prefix = joint_prefix(&robot.missing_joints, &info.joints);
        let prefix = prefix.map_or(String::new(), |prefix| {
            format!("; their names differ by `{prefix}`: give {} {prefix}", Input::JOINT_PREFIX)
        });
        advice.push(format!(
            "joint {} of {} not recorded: record these joint states, or give the URDF of the robot \
             that was recorded{}",
            robot.missing_joints.join(", "),
            if robot.missing_joints.len() == 1 { "the arm is" } else { "the arm are" },
            prefix
        ));
    }
    advice.extend(robot.outside_limits.iter().map(ToString::to_string));
    if !robot.unplaced_joints.is_empty() {
        advice.push(format!(
            "joint {} outside the arm's chain not recorded: its links take no part, unless {} says where it \
             stands",
            robot.unplaced_joints.join(", "),
            Input::JOINT
        ));
    }
}

fn configurations(info: &Info, advice: &mut Vec<String>) {
    let count = info.configurations.len();
    if count < FEWEST {
        advice.push(format!(
            "{count} arm configurations are too few: record at least {FEWEST}, better {ENOUGH} or \
             more, far apart, the arm at rest in each"
        ));
    } else if count < ENOUGH {
        advice.push(format!("{count} arm configurations will do; {ENOUGH} or more are better"));
    }
    let dropped: usize = info.frames.dropped.values().sum();
    let moving = info.frames.dropped.get("moving").copied().unwrap_or(0);
    if moving > 0 && 10 * moving > 9 * (dropped + info.frames.used) {
        advice.push(
            "the arm moves in nearly all frames: let it rest for a second or two in every \
             configuration"
                .to_owned(),
        );
    }
    let stale = info.frames.dropped.get("no_joint_state_near").copied().unwrap_or(0);
    if stale > 0 {
        advice.push(format!(
            "{stale} frames have no joint state near: record joint states all the time, and let \
             both computers keep the same time"
        ));
    }
}

fn depth(info: &Info, advice: &mut Vec<String>) {
    let depth = &info.depth;
    if depth.share_valid < LITTLE_DEPTH {
        advice.push(format!(
            "only {:.0} % of the pixels have depth: check exposure, distance and the depth mode",
            100.0 * depth.share_valid
        ));
    }
    let [near, _, far] = depth.range_m.unwrap_or_default();
    if depth.range_m.is_some() && (far < PLAUSIBLE_M.0 || near > PLAUSIBLE_M.1) {
        advice.push(format!(
            "depth lies between {near:.3} and {far:.3} m, which no camera before an arm sees: \
             check the unit"
        ));
    }
}

fn clock(info: &Info, advice: &mut Vec<String>) {
    let Some(clock) = info.clock else { return };
    let apart_s = clock.offset_s.abs();
    if clock.applied && apart_s > clock.uncertainty_s.max(SAME_S) {
        let how = if clock.seen_in_motion {
            "by the motion in both"
        } else {
            "by the times of recording"
        };
        advice.push(format!(
            "stamps of depth and joints are {apart_s:.3} s apart {how}, which was made up for to \
             {:.3} s: stamp both by one clock",
            clock.uncertainty_s
        ));
    } else if !clock.applied && apart_s > LATE_S {
        let later = if clock.offset_s > 0.0 { "depth" } else { "joint states" };
        advice.push(format!(
            "{later} came {apart_s:.2} s later after their stamps than the other: frames near motion \
             are left out; synchronise the clocks if they are of two computers"
        ));
    }
}
