//! The calibration of the paper, step by step: the pose of the end-effector in every frame, outliers left out, means
//! over the frames of a configuration, then over the configurations.
//!
//! To measure against, and for whoever wants the published method: `pipeline` ends nearer to the truth. What the paper's
//! code computes and does not use (outliers), or measures from the identity (rotations), is done as it was meant.

mod average;
mod chain;
mod error;
mod frame;
mod outliers;

pub use average::{Averaged, FramePose, Group, average};
pub use chain::{FrameLabels, Paper, calibrate};
pub use error::PaperError;
pub use frame::{FrameEstimator, FramePoses, Insane};
pub use outliers::{inliers, modified_z_scores};
