//! A topic of a bag, for people.

use serde::Serialize;

/// A topic of a bag, for people.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TopicSummary {
    /// Name.
    pub name: String,
    /// Type of its messages, as in `sensor_msgs/Image`.
    pub message_type: String,
    /// What the messages are to the recording, where that is known: `depth`, `joints`...
    pub role: Option<&'static str>,
    /// Number of messages.
    pub count: u64,
    /// Bytes of all messages.
    pub bytes: u64,
    /// Messages a second, of topics with more than one.
    pub rate_hz: Option<f64>,
    /// The frame that its messages are in.
    pub frame_id: Option<String>,
    /// What is wrong with it, in words.
    pub problems: Vec<String>,
}
