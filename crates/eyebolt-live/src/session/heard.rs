//! What was heard so far.

use super::event::Event;
use crate::incoming::Incoming;
use std::collections::{BTreeMap, BTreeSet};

/// What was heard so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Heard {
    /// Types of the messages, by topic.
    topics: BTreeMap<String, String>,
    unreadable: BTreeSet<String>,
    lost: BTreeMap<String, u64>,
    description: Option<String>,
}

/// Topics that are kept account of.
const MOST_TOPICS: usize = 1000;

impl Heard {
    /// Notes that a message came, and how many did not.
    pub(super) fn note(&mut self, message: &Incoming) -> Vec<Event> {
        let Incoming { topic, message_type, lost_before, .. } = message;
        let mut events = Vec::new();
        if !self.topics.contains_key(topic) && self.topics.len() < MOST_TOPICS {
            self.topics.insert(topic.clone(), message_type.clone());
            let (topic, message_type) = (topic.clone(), message_type.clone());
            events.push(Event::Heard { topic, message_type });
        }
        if *lost_before > 0 && self.topics.contains_key(topic) {
            let total = self.lost.entry(topic.clone()).or_default();
            *total += lost_before;
            let (topic, total) = (topic.clone(), *total);
            events.push(Event::Lost { topic, count: *lost_before, total });
        }
        events
    }

    /// That a message cannot be read; told once of a topic.
    pub(super) fn unreadable(&mut self, message: &Incoming, problem: String) -> Option<Event> {
        let topic = message.topic.clone();
        let first = self.topics.contains_key(&topic) && self.unreadable.insert(topic.clone());
        first.then_some(Event::Unreadable { topic, problem })
    }

    /// A text that may be a description of a robot.
    pub(super) fn description(&mut self, text: String) -> Option<Event> {
        let new = self.description.as_ref() != Some(&text);
        if !new {
            return None;
        }
        self.description = Some(text.clone());
        Some(Event::Description(text))
    }

    pub(super) fn lost(&self) -> &BTreeMap<String, u64> {
        &self.lost
    }

    /// What was not heard yet.
    pub(super) fn missing(&self, has_arm: bool) -> Vec<&'static str> {
        let heard =
            |types: &[&str]| self.topics.values().any(|heard| types.contains(&heard.as_str()));
        let depth = [
            "sensor_msgs/msg/Image",
            "sensor_msgs/msg/CompressedImage",
            "sensor_msgs/msg/PointCloud2",
        ];
        // Clouds need no intrinsics.
        let info = heard(&["sensor_msgs/msg/CameraInfo"]) || heard(&depth[2..]);
        let needed = [
            ("depth images", heard(&depth)),
            ("camera info", info),
            ("joint states", heard(&["sensor_msgs/msg/JointState"])),
            ("the robot description", has_arm),
        ];
        needed.into_iter().filter(|(_, there)| !there).map(|(what, _)| what).collect()
    }
}
