//! Rigid transforms with frame types, tangents, means, cameras, depth images, clouds and voxels.
//!
//! SI units and radians. `a_from_b` maps coordinates in frame `b` to coordinates in frame `a`.
//! The same input gives the same bytes on any number of threads.

mod camera;
mod cloud;
mod depth_image;
mod distortion;
pub mod frame;
mod image;
mod mask;
mod mean;
mod normals;
mod projection_fit;
mod ray_table;
mod rigid_fit;
mod symmetric;
mod tangent;
mod transform;
mod voxel;

pub use camera::{CameraError, PinholeCamera};
pub use cloud::{BoundingBox, Cloud, optical_from_body};
pub use depth_image::DepthImage;
pub use distortion::Distortion;
pub use frame::{Base, Camera, CoordinateFrame, EndEffector, Link};
pub use image::ImageError;
pub use mask::Mask;
pub use mean::{MeanError, intrinsic_mean_rotation, mean_rotation, mean_transform};
pub use normals::{NormalOptions, NormalsError, fast_normals, normals};
pub use projection_fit::{ProjectionFit, ProjectionFitError, fit_projection};
pub use ray_table::RayTable;
pub use rigid_fit::{Correspondence, rigid_fit};
pub use tangent::{
    Tangent, left_jacobian, rotation_exp, rotation_left_jacobian, rotation_left_jacobian_inverse,
    rotation_log,
};
pub use transform::Transform;
pub use voxel::{VoxelError, VoxelKey, Voxels, voxel_downsample};
