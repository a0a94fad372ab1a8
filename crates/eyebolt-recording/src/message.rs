//! ROS messages, from bytes and to bytes.
//!
//! Only the types that a calibration needs, each with the fields of its definition in their order.
//! ROS 1 and ROS 2 differ in how they write, not in what: [`WireReader`] knows both ways.

mod camera_info;
mod cloud;
mod compressed_color;
mod compressed_depth;
mod diagnostics;
mod header;
mod image;
mod joint_state;
mod marker_array;
mod painted_cloud;
mod pose;
mod rvl;
mod string;
#[cfg(test)]
mod tests;
mod transforms;
pub(crate) mod types;
mod wire;
mod writer;

pub(crate) use camera_info::CameraInfoMessage;
pub(crate) use cloud::{CloudMessage, PointField};
pub(crate) use compressed_color::color;
pub(crate) use compressed_depth::CompressedImageMessage;
pub use diagnostics::{Diagnostic, DiagnosticLevel, diagnostic_message};
pub(crate) use header::Header;
pub(crate) use image::{ImageMessage, is_depth_encoding};
pub(crate) use joint_state::JointStateMessage;
pub use marker_array::{Marker, MarkerShape, markers_message};
pub(crate) use marker_array::{MarkerFrame, placed_markers_message};
pub use painted_cloud::{PaintedCloud, PointValues};
pub use pose::UncertainPose;
pub(crate) use string::text;
pub use string::text_message;
pub(crate) use transforms::transforms;
pub use transforms::{StaticTransform, write_transforms};
pub(crate) use wire::{WireProblem, WireReader};
