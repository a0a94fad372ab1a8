//! What can be wrong with an export.

use super::frame_name::{BadFrameName, FrameName};
use eyebolt_robot::{Input, RobotError};
use std::io;

/// Why a calibration cannot be exported. The text names the remedy, and the file and field where
/// the fault is in one.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// A bag of transforms cannot be read.
    #[error(transparent)]
    Bag(#[from] eyebolt_recording::RecordingError),
    /// The operating system would not give the file.
    #[error("{file}: cannot read: {cause}. Check that the file exists and may be read")]
    Read {
        /// The file.
        file: String,
        /// What the operating system said. Part of the text, so no `source` of the error.
        cause: io::Error,
    },
    /// The file is there and says something that cannot be right.
    #[error("{file}: {field}: {problem}. {remedy}")]
    Invalid {
        /// The file.
        file: String,
        /// The field, or the place in the file.
        field: String,
        /// What was found there.
        problem: String,
        /// What to do about it.
        remedy: String,
    },
    /// The robot description that gives the static transforms cannot be read.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// The calibration was refused when it was made.
    #[error(
        "{file}: verdict: refused: {reasons}. Remove the cause and calibrate again, or give {} to \
         export a pose that is not to be trusted",
        Input::EVEN_IF_REFUSED
    )]
    Refused {
        /// The calibration file.
        file: String,
        /// Its reasons, in one line.
        reasons: String,
    },
    /// There is nothing to export.
    #[error(
        "{file}: base_from_camera: no pose was found, so there is none to export. Calibrate again"
    )]
    NoPose {
        /// The calibration file.
        file: String,
    },
    /// A frame asked for has no name that every format can carry.
    #[error(transparent)]
    FrameName(#[from] BadFrameName),
    /// The recording did not say what the depth optical frame is called.
    #[error(
        "{file}: frames.camera: the calibration does not say what the depth optical frame is \
         called. Give its name with {}: the frame_id of the camera's camera_info",
        Input::OPTICAL_FRAME
    )]
    UnnamedCamera {
        /// The calibration file.
        file: String,
    },
    /// A frame was asked for that is nowhere.
    #[error(
        "no frame is called {wanted}; the frames are {known}. Name one of these, or give the static \
         transforms that lead to it with {}",
        Input::CAMERA_TREE
    )]
    UnknownFrame {
        /// The frame asked for.
        wanted: FrameName,
        /// All frames, for a person to read.
        known: String,
    },
    /// No chain of static transforms leads from one frame to the other.
    #[error(
        "no static transforms lead from {parent} to {child}: {parent} is connected to {reached}; it \
         is not connected to {apart}. Give the static transforms in between with {}",
        Input::CAMERA_TREE
    )]
    Unconnected {
        /// The parent asked for.
        parent: FrameName,
        /// The child asked for.
        child: FrameName,
        /// The frames on the parent's side, for a person to read.
        reached: String,
        /// The others.
        apart: String,
    },
    /// The static transforms already say where the camera is.
    #[error(
        "{tree}: {base} and {camera} are connected without this calibration: {chain}. Leave out the \
         transforms of the earlier calibration: stop its publisher and store /tf_static again"
    )]
    AlreadyConnected {
        /// Where the static transforms come from.
        tree: String,
        /// The calibration's base.
        base: FrameName,
        /// Its depth optical frame.
        camera: FrameName,
        /// The frames on the way, for a person to read.
        chain: String,
    },
    /// Parent and child are one frame.
    #[error("parent and child are both {frame}: a frame has no pose in itself. Name two frames")]
    SameFrame {
        /// The frame.
        frame: FrameName,
    },
}

impl ExportError {
    /// The input that is at fault, or that would help.
    pub fn input(&self) -> Option<Input> {
        match self {
            Self::Robot(error) => error.input(),
            Self::Refused { .. } => Some(Input::EVEN_IF_REFUSED),
            Self::UnnamedCamera { .. } => Some(Input::OPTICAL_FRAME),
            Self::UnknownFrame { .. } | Self::Unconnected { .. } => Some(Input::CAMERA_TREE),
            _ => None,
        }
    }

    /// A name that is none, in `field` of `file`.
    pub(super) fn bad_name(file: &str, field: impl Into<String>, bad: &BadFrameName) -> Self {
        Self::invalid(file, field, bad.found(), BadFrameName::REMEDY)
    }

    pub(super) fn invalid(
        file: &str,
        field: impl Into<String>,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self::Invalid {
            file: file.to_owned(),
            field: field.into(),
            problem: problem.into(),
            remedy: remedy.into(),
        }
    }
}
