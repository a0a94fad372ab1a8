//! ROS messages, from bytes and to bytes.
//!
//! Only the types that a calibration needs, each with the fields of its definition in their order.
//! ROS 1 and ROS 2 differ in how they write, not in what: [`WireReader`] knows both ways.

mod camera_info;
mod cloud;
mod compressed_depth;
mod header;
mod image;
mod joint_state;
mod rvl;
#[cfg(test)]
mod tests;
mod transforms;
mod wire;
mod writer;

pub(crate) use camera_info::CameraInfoMessage;
pub(crate) use cloud::{CloudMessage, PointField};
pub(crate) use compressed_depth::CompressedImageMessage;
pub(crate) use header::Header;
pub(crate) use image::{ImageMessage, is_depth_encoding};
pub(crate) use joint_state::JointStateMessage;
pub use transforms::StaticTransform;
pub(crate) use transforms::{transforms, write_transforms};
pub(crate) use wire::{WireProblem, WireReader};
pub(crate) use writer::WireWriter;

/// Names of the types, as [`crate::bag::Topic::message_type`] has them.
pub(crate) mod types {
    pub(crate) const IMAGE: &str = "sensor_msgs/Image";
    pub(crate) const COMPRESSED_IMAGE: &str = "sensor_msgs/CompressedImage";
    pub(crate) const CLOUD: &str = "sensor_msgs/PointCloud2";
    pub(crate) const CAMERA_INFO: &str = "sensor_msgs/CameraInfo";
    pub(crate) const JOINT_STATE: &str = "sensor_msgs/JointState";
    pub(crate) const STRING: &str = "std_msgs/String";
    pub(crate) const TRANSFORMS: &str = "tf2_msgs/TFMessage";
    /// Of ROS 1's first transform library, still found in bags.
    pub(crate) const OLD_TRANSFORMS: &str = "tf/tfMessage";
}

/// The text of a `std_msgs/String`.
pub(crate) fn text<'a>(reader: &mut WireReader<'a>) -> Result<&'a str, WireProblem> {
    reader.string("data")
}
