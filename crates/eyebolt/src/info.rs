//! What is in a recording, what of it fits the robot, and what to do about the rest.

mod advice;
mod depth;

pub use advice::NO_ROBOT;

use crate::record::{OutsideLimits, RecordError, WorstOutside, group_frames};
use depth::depth_statistics;
use eyebolt_recording::{DropReason, Recording, RecordingError, TopicSummary};
use eyebolt_robot::{Arm, JointPositions};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

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
    /// Joints of the arm that are not recorded.
    pub missing_joints: Vec<String>,
    /// Other joints below the base that are not recorded: fingers, for example.
    pub assumed_joints: Vec<String>,
    /// Recorded joints that the robot does not have.
    pub unknown_joints: Vec<String>,
    /// Joints recorded outside their limits.
    pub outside_limits: Vec<OutsideLimits>,
}

/// Frames listed one by one.
const MOST_LISTED: usize = 1000;

impl Info {
    /// Looks at `recording`, and at how it fits `arm` if one is known.
    ///
    /// # Errors
    ///
    /// Frames that cannot be read.
    pub fn new(recording: &Recording, arm: Option<&Arm>) -> Result<Self, RecordingError> {
        let bag = recording.bag();
        let joints = all_joints(recording)?;
        let mut info = Self {
            schema: SCHEMA,
            kind: bag.map_or("folder", |bag| bag.kind().name()),
            topics: bag.map(|bag| bag.topics()).unwrap_or_default(),
            depth: depth_statistics(recording)?,
            frames: frames(recording),
            clock: bag.and_then(|bag| bag.clock_offset()).map(|offset| Clock {
                offset_s: offset.seconds,
                uncertainty_s: offset.uncertainty_s,
                applied: offset.applied,
                seen_in_motion: offset.seen,
            }),
            joints,
            configurations: configurations(recording, arm)?,
            robot: arm.map(|arm| fit(recording, arm)).transpose()?,
            damage: bag
                .map(|bag| bag.damage())
                .unwrap_or_default()
                .iter()
                .map(ToString::to_string)
                .collect(),
            advice: Vec::new(),
        };
        info.advice = advice::advice(&info);
        Ok(info)
    }

    /// As indented JSON with a line break at its end.
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("plain data");
        text.push('\n');
        text
    }
}

fn all_joints(recording: &Recording) -> Result<Vec<String>, RecordingError> {
    let mut names = BTreeSet::new();
    for index in 0..recording.frame_names().len() {
        let joints = recording.read_joints(index)?;
        let new: Vec<_> = joints.iter().filter(|(name, _)| !names.contains(*name)).collect();
        names.extend(new.into_iter().map(|(name, _)| name.to_owned()));
    }
    Ok(names.into_iter().collect())
}

fn frames(recording: &Recording) -> Frames {
    let bag = recording.bag();
    let all = bag.map(|bag| bag.dropped_frames()).unwrap_or_default();
    let listed = all.iter().take(MOST_LISTED).map(|frame| Dropped {
        frame: frame.index,
        stamp_s: frame.stamp_s,
        kind: reason(&frame.reason),
        reason: frame.reason.to_string(),
    });
    Frames {
        used: recording.frame_names().len(),
        dropped: left_out(recording),
        dropped_frames: listed.collect(),
        motion_limit_deg: bag.map(|bag| bag.motion_limit().to_degrees()),
    }
}

/// How many frames of a bag do not take part, by reason.
pub fn left_out(recording: &Recording) -> BTreeMap<&'static str, usize> {
    let mut counts = BTreeMap::new();
    for frame in recording.bag().map(|bag| bag.dropped_frames()).unwrap_or_default() {
        *counts.entry(reason(&frame.reason)).or_default() += 1;
    }
    counts
}

/// One word for a reason.
fn reason(reason: &DropReason) -> &'static str {
    match reason {
        DropReason::Moving { .. } => "moving",
        DropReason::StaleJoints { .. } => "no_joint_state_near",
        DropReason::StampBackward => "stamp_backward",
        DropReason::Empty => "empty",
        DropReason::Unreadable(_) => "unreadable",
    }
}

/// Configurations as a calibration would see them; without a robot, or with the wrong one, by the
/// joints alone.
fn configurations(
    recording: &Recording,
    arm: Option<&Arm>,
) -> Result<Vec<Configuration>, RecordingError> {
    let names = recording.frame_names();
    let configuration = |frames: &Vec<usize>| Configuration {
        frames: frames.len(),
        first_frame: frames.first().and_then(|f| names.get(*f)).cloned().unwrap_or_default(),
    };
    if let Some(arm) = arm {
        match group_frames(recording, arm, |_, _| {}) {
            Ok(groups) => return Ok(groups.iter().map(|g| configuration(&g.frames)).collect()),
            Err(RecordError::Recording(error)) => return Err(error),
            Err(_) => {}
        }
    }
    let mut groups: Vec<(JointPositions, Vec<usize>)> = Vec::new();
    for index in 0..names.len() {
        let joints = recording.read_joints(index)?;
        // From the last one, which it mostly is.
        match groups.iter_mut().rev().find(|(first, _)| same_joints(first, &joints)) {
            Some((_, frames)) => frames.push(index),
            None => groups.push((joints, vec![index])),
        }
    }
    Ok(groups.iter().map(|(_, frames)| configuration(frames)).collect())
}

/// Joints this near to each other are at rest in one place, radians or metres.
const SAME: f64 = 0.01;

fn same_joints(a: &JointPositions, b: &JointPositions) -> bool {
    a.len() == b.len()
        && a.iter().all(|(name, position)| {
            b.get(name).is_some_and(|other| (other - position).abs() <= SAME)
        })
}

fn fit(recording: &Recording, arm: &Arm) -> Result<RobotFit, RecordingError> {
    let mut fit = RobotFit {
        name: arm.robot().name.clone(),
        base: arm.base_name().to_owned(),
        end_effector: arm.end_effector_name().to_owned(),
        missing_joints: Vec::new(),
        assumed_joints: Vec::new(),
        unknown_joints: Vec::new(),
        outside_limits: Vec::new(),
    };
    let mut outside = WorstOutside::default();
    for (index, frame) in recording.frame_names().iter().enumerate() {
        let joints = recording.read_joints(index)?;
        outside.add(arm, frame, &joints);
        let lacking = |name: &&str| joints.get(name).is_none();
        add_new(&mut fit.missing_joints, arm.required_joints().into_iter().filter(lacking));
        add_new(&mut fit.assumed_joints, arm.other_joints().into_iter().filter(lacking));
        let unknown = arm.unknown_joints(&joints);
        add_new(&mut fit.unknown_joints, unknown.iter().map(String::as_str));
    }
    fit.outside_limits = outside.into_vec();
    Ok(fit)
}

fn add_new<'a>(names: &mut Vec<String>, found: impl Iterator<Item = &'a str>) {
    for name in found {
        if !names.iter().any(|known| known == name) {
            names.push(name.to_owned());
        }
    }
}
