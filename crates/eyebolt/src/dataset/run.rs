//! The frames of one recording, labelled one by one.

use super::applied::start;
use crate::end_effector::EndEffector;
use crate::export::{ExportError, SavedCalibration};
use crate::label::{Contradiction, FrameLabeller, LabelledFrame};
use crate::observations::Observations;
use crate::record::{RecordError, RecordOptions, SingleFrames};
use eyebolt_geometry::PinholeCamera;
use eyebolt_recording::FrameSource;
use eyebolt_robot::{Arm, JointPositions};
use std::fmt;

/// Labels the frames of a recording whose calibration is known.
pub struct LabelRun<'a> {
    source: &'a dyn FrameSource,
    frames: SingleFrames<'a>,
    labeller: FrameLabeller<'a>,
    /// Frames before this one show the camera in another place.
    first: usize,
}

/// A frame that can be learned from.
#[derive(Clone, Debug, PartialEq)]
pub struct Labelled {
    /// What was seen, and its labels.
    pub frame: LabelledFrame,
    /// The joints, as recorded.
    pub joints: JointPositions,
}

/// Why a frame has no labels.
#[derive(Clone, Debug, PartialEq)]
pub enum LeftOut {
    /// It shows the arm elsewhere.
    Contradicts(Contradiction),
    /// The camera was moved after it.
    BeforeCameraMoved,
    /// A joint that carries a link has no position in it.
    Unplaced,
    /// It cannot be read, and is one of those that may be left out.
    Unreadable(String),
}

impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Contradicts(contradiction) => contradiction.fmt(f),
            Self::BeforeCameraMoved => f.write_str(
                "the camera was moved after it, and the calibration is of the later place",
            ),
            Self::Unplaced => f.write_str("a joint that carries a link of the arm has no position"),
            Self::Unreadable(problem) => f.write_str(problem),
        }
    }
}

impl<'a> LabelRun<'a> {
    /// For the recording `source`, which `observations` were made of by `options`, by `calibration`.
    ///
    /// # Errors
    ///
    /// A calibration without a pose.
    pub fn new(
        source: &'a dyn FrameSource,
        (observations, options): (&'a Observations, &'a RecordOptions),
        (arm, end_effector): (&'a Arm, &'a EndEffector),
        calibration: &SavedCalibration,
    ) -> Result<Self, ExportError> {
        let at = start(calibration, observations, true)?;
        let moved_before = calibration.corrections().camera_moved_before.as_ref();
        let place = |name: &String| source.frame_names().iter().position(|other| other == name);
        Ok(Self {
            source,
            frames: SingleFrames::new(source, observations, options),
            labeller: FrameLabeller::new(observations, arm, end_effector, at),
            first: moved_before.and_then(place).unwrap_or(0),
        })
    }

    /// The camera of the images, as the calibration found it.
    pub fn camera(&self) -> &PinholeCamera {
        self.labeller.camera()
    }

    /// Reads and labels frame `index` of the recording.
    ///
    /// # Errors
    ///
    /// A frame that cannot be read or does not fit the robot.
    pub fn frame(&self, index: usize) -> Result<Result<Labelled, LeftOut>, RecordError> {
        if index < self.first {
            return Ok(Err(LeftOut::BeforeCameraMoved));
        }
        let seen = match self.frames.read(index) {
            Err(RecordError::Recording(error)) if self.source.may_leave_out(&error) => {
                return Ok(Err(LeftOut::Unreadable(error.to_string())));
            }
            read => read?,
        };
        let labelled = self.labeller.label(&seen.depth, seen.mask.as_ref(), &seen.joints);
        let name = || self.source.frame_names().get(index).cloned().unwrap_or_default();
        let labelled =
            labelled.map_err(|source| RecordError::Kinematics { frame: name(), source })?;
        Ok(match labelled {
            None => Err(LeftOut::Unplaced),
            Some(LabelledFrame { contradiction: Some(contradiction), .. }) => {
                Err(LeftOut::Contradicts(contradiction))
            }
            Some(frame) => Ok(Labelled { frame, joints: seen.joints }),
        })
    }
}
