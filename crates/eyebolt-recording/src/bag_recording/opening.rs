//! What is made of a scan when a bag is opened, and what keeps it from being a recording.

use super::choose::{Chosen, picture_of};
use super::scan::{Content, FrameEntry, Scan, TopicScan};
use super::stamps;
use super::track::Track;
use super::{BagOptions, BagRecording, pair, skew};
use crate::bag::Bag;
use crate::camera_info::CameraInfo;
use crate::error::RecordingError;
use crate::manifest::{CloudFrame, RobotSection};
use crate::message::{CameraInfoMessage, WireReader, types};
use crate::own_metadata::{BACKGROUND_TOPIC, check_names};
use crate::provenance::ClockOffset;

impl BagRecording {
    /// Whether the frames are of a rectified picture. By ROS's convention, these have a word for it
    /// in their name, and clouds are made of them.
    fn is_rectified(&self) -> bool {
        let topic = self.range_topic();
        let mut words = picture_of(&topic.name).rsplit('/').next().unwrap_or_default().split('_');
        topic.message_type == types::CLOUD || words.any(|w| matches!(w, "rect" | "rectified"))
    }

    /// The camera, from the file that an option names or from its topic.
    pub(super) fn read_camera(
        &self,
        options: &BagOptions,
    ) -> Result<Option<CameraInfo>, RecordingError> {
        if let Some(path) = &options.camera_info {
            return CameraInfo::read_for(path, self.is_rectified()).map(Some);
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
        let rectified = self.is_rectified();
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
        let known = self.known_names()?.filter(|names| names.len() == frames.len());
        let name = |index: usize| {
            let known = known.as_ref().and_then(|names| names.get(index));
            known.cloned().unwrap_or_else(|| index.to_string())
        };
        self.names = paired.kept.iter().map(|kept| name(kept.index)).collect();
        self.provenance.clock_offset = offset;
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
}

/// The frame of clouds that a flag once said, where eyebolt wrote the bag.
pub(super) fn known_cloud_frame(bag: &Bag) -> Option<CloudFrame> {
    CloudFrame::named(bag.metadata()?.get("cloud_frame")?)
}

/// The topic of the backgrounds, where eyebolt wrote the bag.
pub(super) fn known_background(bag: &Bag) -> Option<&str> {
    bag.metadata()?.get(BACKGROUND_TOPIC).map(String::as_str)
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
