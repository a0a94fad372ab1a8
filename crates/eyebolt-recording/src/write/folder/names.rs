//! Names of the files that are not one of many.

/// The camera's intrinsics.
pub(super) const CAMERA_INFO: &str = "camera_info.yaml";
/// The positions of the joints in all frames.
pub(super) const JOINTS: &str = "joints.csv";
/// The robot description.
pub(super) const URDF: &str = "robot.urdf";
/// The static transforms around the camera.
pub(super) const TF_STATIC: &str = "tf_static.yaml";
