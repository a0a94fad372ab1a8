//! Laws of the crate, then examples.

mod camera;
mod cloud;
mod depth_image;
mod mask;
mod mean;
mod normals;
mod projection_fit;
mod strategies;
mod tangent;
mod transform;
mod voxel;
