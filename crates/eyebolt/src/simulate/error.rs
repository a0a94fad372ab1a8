//! Why something cannot be simulated.

use super::rejected::Rejected;
use crate::record::RecordError;
use eyebolt_geometry::CameraError;
use eyebolt_recording::{RecordingError, WriteError};
use eyebolt_robot::Input;

/// Why something cannot be simulated.
#[derive(Debug, thiserror::Error)]
pub enum SimulateError {
    /// The robot's shapes cannot be read.
    #[error(transparent)]
    Robot(#[from] RecordError),
    /// Too few configurations are fit to be seen.
    #[error("only {found} configurations are fit to be seen, and {wanted} are wanted: {rejected}")]
    Unfit {
        /// How many were found.
        found: usize,
        /// How many were wanted.
        wanted: usize,
        /// Why the others were not.
        rejected: Rejected,
    },
    /// A configuration does not say where all joints of the arm are.
    #[error(
        "configuration {index} does not tell where all joints of the arm are; name each of them"
    )]
    Unposed {
        /// Its place, from 0.
        index: usize,
    },
    /// A camera is bumped between two configurations, and there is one.
    #[error(
        "{}: the camera is bumped halfway, so give at least two {}",
        Input::BUMP,
        Input::CONFIGURATIONS
    )]
    BumpOfOne,
    /// Faults leave the camera no valid intrinsics.
    #[error(
        "{focal_scale}, {centre}: {0}; give a factor near 1 and a few pixels",
        focal_scale = Input::FOCAL_SCALE,
        centre = Input::CENTRE
    )]
    Intrinsics(#[from] CameraError),
    /// A frame is not one that a source of frames takes.
    #[error(transparent)]
    Frame(#[from] RecordingError),
    /// The recording cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

impl SimulateError {
    /// The input that is at fault, or that would help.
    pub fn input(&self) -> Option<Input> {
        match self {
            Self::Unfit { rejected, .. } => Some(rejected.input()),
            Self::BumpOfOne => Some(Input::BUMP),
            Self::Intrinsics(_) => Some(Input::FOCAL_SCALE),
            Self::Robot(_) | Self::Frame(_) | Self::Write(_) | Self::Unposed { .. } => None,
        }
    }
}
