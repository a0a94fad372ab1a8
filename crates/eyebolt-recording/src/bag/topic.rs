//! What the messages of a bag belong to.

/// A stream of messages of one type.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Topic {
    /// As in `/camera/depth/image_raw`.
    pub(crate) name: String,
    /// Type of its messages without ROS 2's `msg`, as in `sensor_msgs/Image`.
    pub(crate) message_type: String,
    /// How its messages are written.
    pub(crate) encoding: Encoding,
}

/// How messages are written as bytes.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Encoding {
    /// ROS 2: OMG's Common Data Representation behind four bytes that tell its byte order.
    Cdr,
    /// ROS 1.
    Ros1,
    /// By another rule, of this name.
    Other(String),
}

/// The type's name without ROS 2's `msg`.
pub(crate) fn ros_type(name: &str) -> String {
    name.replacen("/msg/", "/", 1)
}
