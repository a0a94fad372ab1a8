//! What to calibrate by a marker, and why that may end without an outcome.

use crate::calibrate::Limits;
use crate::progress::Cancelled;
use crate::record::RecordError;
use eyebolt_markers::Target;
use eyebolt_recording::FrameSource;
use eyebolt_robot::Arm;

/// What to calibrate, and by which marker.
#[derive(Clone, Debug)]
pub struct MarkerRequest<'a> {
    /// Where the frames come from.
    pub source: &'a dyn FrameSource,
    /// The arm that carries the marker or the camera.
    pub arm: &'a Arm,
    /// What is looked for.
    pub target: Target,
    /// What an answer has to meet to be trusted.
    pub limits: Limits,
    /// Of more configurations, those are used that differ most.
    pub most_configurations: usize,
}

/// Why there is no outcome at all.
#[derive(Debug, thiserror::Error)]
pub enum MarkerFailure {
    /// The recording or the robot cannot be read, or do not fit.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// There is nothing to look for a marker in.
    #[error(
        "the recording has no colour pictures of a known camera, and a marker is seen in these alone: record \
         the colour topic with its camera_info (in a folder: frames.color and camera.info), or calibrate \
         without a marker"
    )]
    NoPictures,
    /// Pictures of one recording are of different cameras.
    #[error("frame {frame}: its picture is of another camera than those before: record them apart")]
    OtherCamera {
        /// Name of the frame.
        frame: String,
    },
    /// Whoever hears of the progress ended it.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
