//! A recording whose joints are called otherwise than the robot's, or that lacks some of them.

use crate::color::{CameraPicture, ColorImage};
use crate::error::RecordingError;
use crate::frame::Frame;
use crate::frame_source::FrameSource;
use crate::manifest::RobotSection;
use crate::message::StaticTransform;
use crate::provenance::Provenance;
use crate::recording::Recording;
use eyebolt_geometry::{DepthImage, PinholeCamera};
use eyebolt_robot::{JointPositions, Robot};
use std::collections::BTreeSet;

/// What a caller knows of the joints that the recording does not say.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JointNotes {
    /// What the recording's names have before the robot's, or the robot's before the recording's.
    pub prefix: Option<String>,
    /// Positions that hold in every frame where the joint is not recorded: radians, metres for
    /// prismatic joints.
    pub positions: Vec<(String, f64)>,
}

impl JointNotes {
    /// Whether they change anything.
    pub fn is_empty(&self) -> bool {
        self.prefix.is_none() && self.positions.is_empty()
    }
}

/// A recording with [`JointNotes`] applied: joints have the robot's names.
#[derive(Debug)]
pub struct NotedJoints<'a> {
    recording: Recording<'a>,
    notes: JointNotes,
    /// Names of the robot's joints.
    known: BTreeSet<String>,
}

impl<'a> NotedJoints<'a> {
    /// `recording` as `notes` have it, for `robot`.
    pub fn new(recording: Recording<'a>, notes: JointNotes, robot: &Robot) -> Self {
        let known = robot.joints.iter().map(|joint| joint.name.clone()).collect();
        Self { recording, notes, known }
    }

    /// The robot's name of a recorded joint; its own where the robot has neither.
    fn renamed(&self, name: &str) -> String {
        let prefix = self.notes.prefix.as_deref().filter(|_| !self.known.contains(name));
        let without = prefix.and_then(|prefix| name.strip_prefix(prefix)).map(str::to_owned);
        let with = prefix.map(|prefix| format!("{prefix}{name}"));
        let mut others = [without, with].into_iter().flatten();
        others.find(|other| self.known.contains(other)).unwrap_or_else(|| name.to_owned())
    }

    fn noted(&self, joints: &JointPositions) -> JointPositions {
        // What is recorded counts more than what is stated, and a joint's own name than another.
        let stated = self.notes.positions.iter().cloned();
        let renamed = joints.iter().map(|(name, at)| (self.renamed(name), at));
        let own = joints.iter().filter(|(name, _)| self.known.contains(*name));
        stated.chain(renamed).chain(own.map(|(name, at)| (name.to_owned(), at))).collect()
    }
}

impl FrameSource for NotedJoints<'_> {
    fn camera(&self) -> Option<&PinholeCamera> {
        self.recording.camera()
    }

    fn camera_frame_id(&self) -> Option<&str> {
        self.recording.camera_frame_id()
    }

    fn stamp_ns(&self, index: usize) -> Option<i64> {
        self.recording.source().stamp_ns(index)
    }

    fn robot(&self) -> &RobotSection {
        self.recording.robot()
    }

    fn frame_names(&self) -> &[String] {
        self.recording.frame_names()
    }

    fn has_masks(&self) -> bool {
        self.recording.has_masks()
    }

    fn read_frame(&self, index: usize) -> Result<Frame, RecordingError> {
        let frame = self.recording.read_frame(index)?;
        Ok(Frame { joints: self.noted(&frame.joints), ..frame })
    }

    fn read_joints(&self, index: usize) -> Result<JointPositions, RecordingError> {
        Ok(self.noted(&self.recording.read_joints(index)?))
    }

    fn read_color(&self, index: usize) -> Result<Option<ColorImage>, RecordingError> {
        self.recording.read_color(index)
    }

    fn read_picture(&self, index: usize) -> Result<Option<CameraPicture>, RecordingError> {
        self.recording.read_picture(index)
    }

    fn background_count(&self) -> usize {
        self.recording.background_count()
    }

    fn read_background(&self, index: usize) -> Result<DepthImage, RecordingError> {
        self.recording.read_background(index)
    }

    fn may_leave_out(&self, error: &RecordingError) -> bool {
        self.recording.may_leave_out(error)
    }

    fn in_millimetres(&self) -> bool {
        self.recording.in_millimetres()
    }

    fn integer_unit_m(&self) -> Option<f64> {
        self.recording.integer_unit_m()
    }

    fn static_transforms(&self) -> &[StaticTransform] {
        self.recording.static_transforms()
    }

    fn backgrounds_in_millimetres(&self) -> bool {
        self.recording.backgrounds_in_millimetres()
    }

    fn provenance(&self) -> &Provenance {
        self.recording.provenance()
    }
}

#[cfg(test)]
mod tests;
