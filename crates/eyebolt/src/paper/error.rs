//! What keeps the paper's chain from its work.

use crate::end_effector::EndEffectorError;
use crate::pipeline::Failure;
use crate::pose::{PoseError, RecognizeError};
use crate::progress::Cancelled;
use crate::record::RecordError;

/// What keeps the paper's chain from its work.
#[derive(Debug, thiserror::Error)]
pub enum PaperError {
    /// Of the recording, the robot, or whoever ended it.
    #[error(transparent)]
    Failure(#[from] Failure),
    /// Of the networks that tell pixels.
    #[error(transparent)]
    Recognize(#[from] RecognizeError),
    /// Of those that tell poses.
    #[error(transparent)]
    Pose(#[from] PoseError),
    /// The end-effector has no shape.
    #[error(transparent)]
    EndEffector(#[from] EndEffectorError),
}

impl From<RecordError> for PaperError {
    fn from(error: RecordError) -> Self {
        Self::Failure(error.into())
    }
}

impl From<Cancelled> for PaperError {
    fn from(cancelled: Cancelled) -> Self {
        Self::Failure(cancelled.into())
    }
}
