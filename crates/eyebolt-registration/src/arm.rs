//! An arm's links as shapes, and the arm in one configuration.

mod model;
mod moved;
mod offsets;
mod posture;

pub use model::{ArmJoint, ArmLink, ArmModel, MOST_JOINTS};
pub use offsets::{JointAxis, JointOffsets};
pub use posture::{NearestSurface, Posture};
