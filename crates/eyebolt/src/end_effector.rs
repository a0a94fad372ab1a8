//! The end-effector of any arm, as its description has it: shape, box, keypoints, symmetry.
//!
//! What the paper takes for granted of one hand is worked out from the meshes here, so that labels
//! and networks need no hand of their own. The fingers of a gripper move box and keypoints.

mod bounding_box;
mod corners;
mod described;
mod error;
mod keypoints;
mod preset;
mod reference;
mod shape;
mod surface;
mod symmetry;

pub use bounding_box::BoundingBox;
pub use described::EndEffector;
pub use error::EndEffectorError;
pub use keypoints::{FEWEST_KEYPOINTS, Keypoint, MOST_KEYPOINTS};
pub use symmetry::Symmetry;
