//! Rigid transforms with frame types, tangents, means, cameras, depth images, clouds and voxels.
//!
//! SI units and radians. `a_from_b` maps coordinates in frame `b` to coordinates in frame `a`.

pub mod frame;
mod transform;

pub use frame::{Base, Camera, EndEffector, Frame, Link};
pub use transform::Transform;
