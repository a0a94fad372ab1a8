//! What comes in.

/// A message as it came.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Incoming {
    /// As ROS has it: `/camera/depth/image_rect_raw`.
    pub topic: String,
    /// As ROS has it: `sensor_msgs/msg/Image`.
    pub message_type: String,
    /// CDR behind the four bytes that tell its byte order, as bags have it.
    pub data: Vec<u8>,
    /// When it came, nanoseconds since 1970.
    pub received_ns: i64,
    /// How many messages of the topic got lost before it: sent and never received, or received while there
    /// was no room.
    pub lost_before: u64,
}
