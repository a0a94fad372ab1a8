//! What there is to say of the topics of a bag.

use super::BagRecording;
use super::choose::Chosen;
use super::scan::TopicScan;

/// A topic of a bag, for people.
#[derive(Clone, Debug, PartialEq)]
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

impl BagRecording {
    pub(super) fn summary(&self, number: usize) -> Option<TopicSummary> {
        let topic = self.scan.topics.get(number)?;
        let Chosen { range, camera_info, joints, description, color, mask } = self.chosen;
        let roles = [
            (Some(range), "depth"),
            (camera_info, "intrinsics"),
            (Some(joints), "joints"),
            (description, "robot"),
            (color, "color"),
            (mask, "mask"),
        ];
        let role = roles.into_iter().find(|(role, _)| *role == Some(number)).map(|(_, name)| name);
        let span_s = topic.last_ns.saturating_sub(topic.first_ns) as f64 * 1e-9;
        let rate_hz = (topic.count - 1) as f64 / span_s;
        Some(TopicSummary {
            name: topic.name.clone(),
            message_type: topic.message_type.clone(),
            role,
            count: topic.count,
            bytes: topic.bytes,
            rate_hz: Some(rate_hz).filter(|rate| *rate > 0.0 && rate.is_finite()),
            frame_id: topic.frame_id.clone(),
            problems: problems(topic),
        })
    }
}

fn problems(topic: &TopicScan) -> Vec<String> {
    let mut problems = Vec::new();
    if let Some((_, problem)) = &topic.first_problem {
        problems.push(format!(
            "{} messages cannot be read, the first because of {}: {}",
            topic.unreadable, problem.field, problem.problem
        ));
    }
    if topic.stamps.unset > 0 {
        problems.push(format!(
            "{} messages have no time stamp; the time of recording stands in",
            topic.stamps.unset
        ));
    }
    let (backward, _) = topic.backward();
    if backward > 0 {
        problems.push(format!("{backward} time stamps run backward"));
    }
    problems
}
