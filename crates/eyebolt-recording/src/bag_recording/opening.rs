//! What is made of a scan when a bag is opened, and what keeps it from being a recording.

use super::choose::Chosen;
use super::scan::{Content, FrameEntry, Scan, TopicScan};
use super::stamps::{self, ClockOffset};
use super::track::Track;
use super::{BagOptions, BagRecording, pair, skew};
use crate::bag::Bag;
use crate::camera_info::CameraInfo;
use crate::error::RecordingError;
use crate::joints::{self, looks_like_degrees};
use crate::manifest::{CloudFrame, RobotSection};
use crate::message::{CameraInfoMessage, WireReader};
use crate::write::check_names;

impl BagRecording {
    /// What is wrong with a topic that the recording needs is wrong with the recording.
    pub(super) fn check_topics(&self) -> Result<(), RecordingError> {
        let Chosen { range, camera_info, joints, description, color, mask } = self.chosen;
        let needed = [camera_info, description, color, mask];
        for number in [range, joints].into_iter().chain(needed.into_iter().flatten()) {
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
        let topic = camera_info.map(|number| self.topic(number));
        if let Some(topic) = topic
            && let Content::CameraInfo { changed_ns: Some(changed), .. } = &topic.content
        {
            let problem = format!("the intrinsics change at {}", seconds(*changed));
            let remedy = "Record with one setting of the camera, or give --camera-info with a file";
            return Err(self.invalid(&topic.name, problem, remedy));
        }
        Ok(())
    }

    /// The camera, from the file that an option names or from its topic.
    pub(super) fn read_camera(
        &self,
        options: &BagOptions,
    ) -> Result<Option<CameraInfo>, RecordingError> {
        if let Some(path) = &options.camera_info {
            return CameraInfo::read(path).map(Some);
        }
        let Some(topic) = self.chosen.camera_info.map(|number| self.topic(number)) else {
            return Ok(None);
        };
        let Content::CameraInfo { locator: Some(locator), .. } = &topic.content else {
            return Ok(None);
        };
        let bytes = self.bag.read(*locator)?;
        let message = WireReader::new(&topic.encoding, &bytes)
            .and_then(|mut reader| CameraInfoMessage::read(&mut reader))
            .map_err(|problem| self.unreadable(topic, &problem))?;
        // By ROS's convention, pictures called so were rectified.
        let rectified = self.range_topic().name.contains("rect");
        let info = CameraInfo::from_message(&self.path, &message, rectified);
        info.map(Some).map_err(|error| match error {
            RecordingError::Invalid { field, problem, .. } => {
                let remedy = "Give another topic with --camera-info-topic, or a file with \
                              --camera-info";
                self.invalid(&format!("{}: {field}", topic.name), problem, remedy)
            }
            other => other,
        })
    }

    /// Brings frames and joints together.
    pub(super) fn pair(&mut self, max_motion: Option<f64>) -> Result<(), RecordingError> {
        let (range, joints) = (self.range_topic(), self.topic(self.chosen.joints));
        let Content::Joints(states) = &joints.content else { return Ok(()) };
        let tracks: Vec<_> = states.tracks().iter().collect();
        let frames = self.entries(self.chosen.range);
        let offset = clock_offset(range, joints, frames, &tracks);
        let paired = pair::pair(frames, &tracks, offset, max_motion);
        if paired.kept.is_empty() {
            let first =
                paired.dropped.first().map(|frame| format!("; of the first, {}", frame.reason));
            let problem = format!(
                "none of its {} frames can be used{}",
                frames.len(),
                first.unwrap_or_default()
            );
            let remedy = "Let the arm rest in every configuration while the camera looks on, and \
                          record joint states all the time; --max-motion-deg changes what counts \
                          as rest";
            return Err(self.invalid(&range.name, problem, remedy));
        }
        let name = match self.known_names()?.filter(|names| names.len() == frames.len()) {
            Some(names) => {
                Box::new(move |index: usize| names[index].clone()) as Box<dyn Fn(_) -> _>
            }
            None => Box::new(|index: usize| index.to_string()),
        };
        self.names = paired.kept.iter().map(|kept| name(kept.index)).collect();
        self.clock_offset = offset;
        self.paired = paired;
        Ok(())
    }

    /// Names of all frames, where the bag was written from a folder.
    fn known_names(&self) -> Result<Option<Vec<String>>, RecordingError> {
        let text = self.bag.metadata().and_then(|known| known.get("frame_names"));
        let Some(text) = text else { return Ok(None) };
        let names: Vec<String> = serde_json::from_str(text).map_err(|error| {
            self.invalid("metadata: frame_names", error.to_string(), "Write the file again")
        })?;
        check_names(&self.path, &names)?;
        Ok(Some(names))
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

/// One stamp of so many may run backward: networks deliver some messages out of order.
const MOST_BACKWARD: u64 = 100;

fn seconds(ns: i64) -> String {
    format!("{:.3} s", ns as f64 * 1e-9)
}

/// The frame of clouds that a flag once said, where eyebolt wrote the bag.
pub(super) fn known_cloud_frame(bag: &Bag) -> Option<CloudFrame> {
    match bag.metadata()?.get("cloud_frame")?.as_str() {
        "optical" => Some(CloudFrame::Optical),
        "body" => Some(CloudFrame::Body),
        _ => None,
    }
}

/// How the clocks of depth and joints differ: by the motion, else by the times of recording.
fn clock_offset(
    range: &TopicScan,
    joints: &TopicScan,
    frames: &[FrameEntry],
    tracks: &[&Track],
) -> Option<ClockOffset> {
    let offset = stamps::clock_offset(&range.stamps, &joints.stamps);
    let known = offset.filter(|offset| offset.applied).map_or(0.0, |offset| offset.seconds);
    let Some(skew) = skew::skew(frames, tracks, (known * 1e9).round() as i64) else {
        return offset;
    };
    let (seconds, uncertainty_s) = (known + skew.seconds, skew.uncertainty_s);
    Some(ClockOffset { seconds, uncertainty_s, applied: true, seen: true })
}

/// What the bag says of the robot: its description, and the links where eyebolt wrote the bag.
pub(super) fn robot(bag: &Bag, scan: &Scan, chosen: Chosen) -> RobotSection {
    let description = chosen.description.and_then(|number| scan.topics.get(number));
    let text = description.and_then(|topic| match &topic.content {
        Content::Text(text) => Some(text.clone()),
        _ => None,
    });
    let known = |key: &str| bag.metadata()?.get(key).cloned();
    RobotSection {
        urdf: None,
        description: text,
        base: known("base"),
        end_effector: known("end_effector"),
    }
}
