//! Names of the types, as [`crate::bag::Topic::message_type`] has them.

pub(crate) const IMAGE: &str = "sensor_msgs/Image";
pub(crate) const COMPRESSED_IMAGE: &str = "sensor_msgs/CompressedImage";
pub(crate) const CLOUD: &str = "sensor_msgs/PointCloud2";
pub(crate) const CAMERA_INFO: &str = "sensor_msgs/CameraInfo";
pub(crate) const JOINT_STATE: &str = "sensor_msgs/JointState";
pub(crate) const POSE: &str = "geometry_msgs/PoseWithCovarianceStamped";
pub(crate) const STRING: &str = "std_msgs/String";
pub(crate) const TRANSFORMS: &str = "tf2_msgs/TFMessage";
/// As ROS 2 has it from Humble on; of viewers only.
pub(crate) const MARKERS: &str = "visualization_msgs/MarkerArray";
/// Of ROS 1's first transform library, still found in bags.
pub(crate) const OLD_TRANSFORMS: &str = "tf/tfMessage";
