//! What `eyebolt info` tells.

use crate::joint_limits::OutsideLimits;
use eyebolt_recording::TopicSummary;
use serde::Serialize;
use std::collections::BTreeMap;

/// Name and version of the form of [`Info`].
pub const SCHEMA: &str = "eyebolt.info/1";

/// What `eyebolt info` tells.
#[derive(Clone, Debug, Serialize)]
pub struct Info {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// `folder`, `MCAP`, `rosbag2 (SQLite)` or `ROS 1 bag`.
    pub kind: &'static str,
    /// The topics of a bag.
    pub topics: Vec<TopicSummary>,
    /// The depth.
    pub depth: Depth,
    /// Frames, and which of them take part.
    pub frames: Frames,
    /// How the clocks of depth and joints differ, of bags whose stamps tell.
    pub clock: Option<Clock>,
    /// Names of the joints recorded.
    pub joints: Vec<String>,
    /// Arm configurations, in order of appearance.
    pub configurations: Vec<Configuration>,
    /// What fits the robot; `null` if no robot is known.
    pub robot: Option<RobotFit>,
    /// Parts of the bag that are damaged and were passed over.
    pub damage: Vec<String>,
    /// Whether it can be calibrated; what else could be better is advice.
    pub ready: bool,
    /// What to do, most important first; empty if all is well.
    pub advice: Vec<String>,
}

/// Statistics over some frames, evenly chosen.
#[derive(Clone, Debug, Serialize)]
pub struct Depth {
    /// Pixels in a row and number of rows, unless it is a cloud without order.
    pub size: Option<(u32, u32)>,
    /// Focal lengths and principal point, pixels, if the camera is known.
    pub intrinsics_px: Option<[f64; 4]>,
    /// Name of the optical frame.
    pub frame_id: Option<String>,
    /// Number of frames looked at.
    pub frames_looked_at: usize,
    /// Share of pixels that have depth.
    pub share_valid: f64,
    /// Depth that 5, 50 and 95 of 100 pixels are nearer than, metres.
    pub range_m: Option<[f64; 3]>,
    /// Whether frames have masks of the arm.
    pub masks: bool,
}

/// Frames of a recording.
#[derive(Clone, Debug, Serialize)]
pub struct Frames {
    /// How many take part.
    pub used: usize,
    /// How many do not, by reason.
    pub dropped: BTreeMap<&'static str, usize>,
    /// Those that do not, at most a thousand.
    pub dropped_frames: Vec<Dropped>,
    /// How far a joint may turn while a frame is taken, degrees; of bags.
    pub motion_limit_deg: Option<f64>,
}

/// A frame that does not take part.
#[derive(Clone, Debug, Serialize)]
pub struct Dropped {
    /// Number among all frames.
    pub frame: usize,
    /// Its stamp.
    pub stamp_s: f64,
    /// Why, in a word.
    pub kind: &'static str,
    /// Why, in a sentence.
    pub reason: String,
}

/// How two clocks differ.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Clock {
    /// To be added to stamps of depth for the clock of the joints.
    pub offset_s: f64,
    /// By how much that may be wrong.
    pub uncertainty_s: f64,
    /// Whether it was added.
    pub applied: bool,
    /// Whether the motion that depth and joints both saw tells it; otherwise, the times of
    /// recording do.
    pub seen_in_motion: bool,
}

/// Frames with the arm in one place.
#[derive(Clone, Debug, Serialize)]
pub struct Configuration {
    /// Number of frames.
    pub frames: usize,
    /// Name of the first.
    pub first_frame: String,
}

/// How recording and robot fit.
#[derive(Clone, Debug, Serialize)]
pub struct RobotFit {
    /// Name of the robot.
    pub name: String,
    /// The arm's base link.
    pub base: String,
    /// Its end-effector link.
    pub end_effector: String,
    /// Which of `base` and `end_effector` nobody named, so that they were guessed.
    pub guessed: Vec<&'static str>,
    /// Parts of the description that are wrong and that the arm does not need, a sentence each.
    pub left_out: Vec<String>,
    /// Joints of the arm that are not recorded.
    pub missing_joints: Vec<String>,
    /// Other joints below the base that are not recorded, such as fingers: their links take no part.
    pub unplaced_joints: Vec<String>,
    /// Recorded joints that the robot does not have.
    pub unknown_joints: Vec<String>,
    /// Joints recorded outside their limits.
    pub outside_limits: Vec<OutsideLimits>,
    /// Joints of the arm that are named without saying where they are.
    pub untold_joints: Vec<Untold>,
}

/// A joint that is named without saying where it is.
#[derive(Clone, Debug, Serialize)]
pub struct Untold {
    /// The joint.
    pub joint: String,
    /// Number of frames at rest that are left out for it.
    pub frames: usize,
    /// What is wrong, and how often.
    pub reason: String,
}

impl Info {
    /// As indented JSON with a line break at its end.
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("plain data");
        text.push('\n');
        text
    }
}
