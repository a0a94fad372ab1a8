//! Why nothing can be learned.

use crate::record::RecordError;
use eyebolt_robot::RobotError;

/// Why nothing can be learned.
#[derive(Debug, thiserror::Error)]
pub enum TrainError {
    /// Shapes of the arm cannot be read.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The description is no arm.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// The end-effector has no shape to go by.
    #[error(transparent)]
    EndEffector(#[from] crate::end_effector::EndEffectorError),
    /// A data set that cannot be read.
    #[error(transparent)]
    Dataset(#[from] crate::dataset::DatasetError),
    /// What the network says: weights, features, memory.
    #[error(transparent)]
    Net(#[from] eyebolt_net::Error),
    /// Ended from outside.
    #[error(transparent)]
    Cancelled(#[from] crate::progress::Cancelled),
    /// A checkpoint, a dataset or a picture is not what it should be.
    #[error("{file}: {field}: {problem}")]
    File {
        /// Which file.
        file: String,
        /// Which part of it.
        field: String,
        /// What is wrong, and what to do.
        problem: String,
    },
    /// The camera never sees the arm.
    #[error("no image with the arm in it among {tries}: is the description in metres?")]
    NothingToSee {
        /// Images drawn.
        tries: u64,
    },
}
