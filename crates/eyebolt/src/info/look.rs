//! One look at a recording.

use super::advice;
use super::depth::depth_statistics;
use super::form::{Clock, Configuration, Dropped, Frames, Info, RobotFit, SCHEMA, Untold};
use crate::answer::guessed_links;
use crate::joint_limits::WorstOutside;
use crate::record::{Group, Groups, MOST_CONFIGURATIONS, RecordError, group_frames};
use eyebolt_recording::{FrameSource, Provenance, RecordingError};
use eyebolt_robot::{Arm, JointPositions};
use std::collections::{BTreeMap, BTreeSet};

/// Frames that do not take part are listed one by one up to this.
const MOST_LISTED: usize = 1000;

impl Info {
    /// Looks at `source`, and at how it fits `arm` if one is known.
    ///
    /// # Errors
    ///
    /// Frames that cannot be read.
    pub fn new(source: &dyn FrameSource, arm: Option<&Arm>) -> Result<Self, RecordingError> {
        let provenance = source.provenance();
        let mut info = Self {
            schema: SCHEMA,
            kind: provenance.kind,
            topics: provenance.topics.clone(),
            depth: depth_statistics(source)?,
            frames: frames(source.frame_names().len(), provenance),
            clock: provenance.clock_offset.map(|offset| Clock {
                offset_s: offset.seconds,
                uncertainty_s: offset.uncertainty_s,
                applied: offset.applied,
                seen_in_motion: offset.seen,
            }),
            joints: all_joints(source)?,
            configurations: configurations(source, arm)?,
            robot: arm.map(|arm| fit(source, arm)).transpose()?,
            damage: provenance.damage.clone(),
            ready: false,
            advice: Vec::new(),
        };
        (info.ready, info.advice) = advice::advice(&info, source);
        Ok(info)
    }
}

fn all_joints(source: &dyn FrameSource) -> Result<Vec<String>, RecordingError> {
    let mut names = BTreeSet::new();
    for index in 0..source.frame_names().len() {
        let joints = source.read_joints(index)?;
        let new: Vec<_> = joints.iter().filter(|(name, _)| !names.contains(*name)).collect();
        names.extend(new.into_iter().map(|(name, _)| name.to_owned()));
    }
    Ok(names.into_iter().collect())
}

fn frames(used: usize, provenance: &Provenance) -> Frames {
    let listed = provenance.dropped.iter().take(MOST_LISTED).map(|frame| Dropped {
        frame: frame.index,
        stamp_s: frame.stamp_s,
        kind: frame.reason.name(),
        reason: frame.reason.to_string(),
    });
    Frames {
        used,
        dropped: provenance.dropped_by_reason(),
        dropped_frames: listed.collect(),
        motion_limit_deg: provenance.motion_limit.map(f64::to_degrees),
    }
}

/// Configurations as a calibration would see them; without a robot, or with the wrong one, by the
/// joints alone. No more are told apart than [`MOST_CONFIGURATIONS`].
fn configurations(
    source: &dyn FrameSource,
    arm: Option<&Arm>,
) -> Result<Vec<Configuration>, RecordingError> {
    let names = source.frame_names();
    let configuration = |frames: &Vec<usize>| Configuration {
        frames: frames.len(),
        first_frame: frames.first().and_then(|f| names.get(*f)).cloned().unwrap_or_default(),
    };
    if let Some(arm) = arm {
        match group_frames(source, arm, |_, _| {}) {
            Ok(Groups { groups, .. }) => {
                return Ok(groups.iter().map(|g: &Group| configuration(&g.frames)).collect());
            }
            Err(RecordError::Recording(error)) => return Err(error),
            Err(_) => {}
        }
    }
    let mut groups: Vec<(JointPositions, Vec<usize>)> = Vec::new();
    for index in 0..names.len() {
        let joints = source.read_joints(index)?;
        // From the last one, which it mostly is.
        match groups.iter().rposition(|(first, _)| same_joints(first, &joints)) {
            Some(known) => groups[known].1.push(index),
            None if groups.len() < MOST_CONFIGURATIONS => groups.push((joints, vec![index])),
            None => break,
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

fn fit(source: &dyn FrameSource, arm: &Arm) -> Result<RobotFit, RecordingError> {
    let mut fit = RobotFit {
        name: arm.robot().name.clone(),
        base: arm.base_name().to_owned(),
        end_effector: arm.end_effector_name().to_owned(),
        guessed: guessed_links(arm),
        left_out: arm.left_out().iter().map(ToString::to_string).collect(),
        missing_joints: Vec::new(),
        unplaced_joints: Vec::new(),
        unknown_joints: Vec::new(),
        outside_limits: Vec::new(),
        untold_joints: Vec::new(),
    };
    let untold = &source.provenance().untold_joints;
    let mut missing: BTreeMap<&str, usize> = BTreeMap::new();
    let mut outside = WorstOutside::default();
    for (index, frame) in source.frame_names().iter().enumerate() {
        let joints = source.read_joints(index)?;
        outside.add(arm, frame, &joints);
        let lacking = |name: &&str| joints.get(name).is_none();
        for name in arm.required_joints().into_iter().filter(lacking) {
            *missing.entry(name).or_insert(0) += 1;
        }
        add_new(&mut fit.unplaced_joints, arm.other_joints().into_iter().filter(lacking));
        let unknown = arm.unknown_joints(&joints);
        add_new(&mut fit.unknown_joints, unknown.iter().map(String::as_str));
    }
    for (name, frames) in missing {
        match untold.get(name) {
            Some(reason) => fit.untold_joints.push(Untold {
                joint: name.to_owned(),
                frames,
                reason: reason.clone(),
            }),
            None => fit.missing_joints.push(name.to_owned()),
        }
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
