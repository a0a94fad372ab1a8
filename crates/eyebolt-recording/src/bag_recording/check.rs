//! What is wrong with a topic that the recording needs is wrong with the recording.

use super::BagRecording;
use super::choose::COLOR;
use super::scan::Content;
use crate::error::RecordingError;
use crate::joints::{self, looks_like_degrees};

/// One stamp of so many may run backward: networks deliver some messages out of order.
const MOST_BACKWARD: u64 = 100;

impl BagRecording {
    /// Messages, stamps and intrinsics of the topics that are needed.
    pub(super) fn check_topics(&self) -> Result<(), RecordingError> {
        // Colour is for people only, who do without some pictures.
        for (number, _) in self.chosen.roles().filter(|(_, role)| *role != COLOR) {
            let topic = self.topic(number);
            if let Some((log_time_ns, problem)) =
                topic.first_problem.as_ref().filter(|_| !self.partial)
            {
                let field = format!("{}: {}", topic.name, problem.field);
                let text = format!("{} (message of {})", problem.problem, seconds(*log_time_ns));
                let remedy = "Record it again, or give --partial to go without such messages";
                return Err(self.invalid(&field, text, remedy));
            }
            let (backward, first) = topic.backward();
            if let Some((latest, next)) = first
                && backward > (topic.count / MOST_BACKWARD).max(1)
            {
                let problem = format!(
                    "{backward} of {} stamps run backward, first from {} to {}",
                    topic.count,
                    seconds(latest),
                    seconds(next)
                );
                let remedy =
                    "Two programs publish there, or the clock was set back: record it again";
                return Err(self.invalid(&topic.name, problem, remedy));
            }
        }
        let topic = self.chosen.camera_info.map(|number| self.topic(number));
        if let Some(topic) = topic
            && let Content::CameraInfo { changed_ns: Some(changed), .. } = &topic.content
        {
            let problem = format!("the intrinsics change at {}", seconds(*changed));
            let remedy = "Record with one setting of the camera, or give --camera-info with a file";
            return Err(self.invalid(&topic.name, problem, remedy));
        }
        Ok(())
    }

    /// Joints in degrees would put the arm anywhere.
    pub(super) fn check_joints(&self) -> Result<(), RecordingError> {
        let farthest = |joint: usize| {
            let positions = self.paired.kept.iter().filter_map(|kept| kept.positions.get(joint));
            positions.copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(0.0)
        };
        let joints = self.paired.names.iter().enumerate();
        let joints = joints.map(|(joint, name)| (name, farthest(joint)));
        let suspects: Vec<_> = joints.filter(|(_, far)| looks_like_degrees(*far)).collect();
        // Wheels, which a topic may tell of too, do turn so far; they are the lesser part.
        match suspects.first() {
            Some((name, position)) if 2 * suspects.len() >= self.paired.names.len() => {
                joints::check(&self.path, &self.topic(self.chosen.joints).name, "", name, *position)
            }
            _ => Ok(()),
        }
    }
}

fn seconds(ns: i64) -> String {
    format!("{:.3} s", ns as f64 * 1e-9)
}
