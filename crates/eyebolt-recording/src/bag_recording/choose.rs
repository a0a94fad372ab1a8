//! Which topics of a bag are the recording.

mod candidates;
mod depth;
mod kinds;

pub(super) use kinds::is_rectified;

use super::options::BagOptions;
use super::scan::{Scan, TopicScan};
use crate::error::RecordingError;
use candidates::{By, Candidates, Wanted};
use eyebolt_robot::Input;
use kinds::{encoding, is_color, is_description, is_joints, is_mask, size};
use std::path::Path;

/// Numbers of topics in a scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Chosen {
    pub(super) range: usize,
    pub(super) camera_info: Option<usize>,
    pub(super) joints: usize,
    pub(super) description: Option<usize>,
    pub(super) color: Option<usize>,
    pub(super) mask: Option<usize>,
    pub(super) background: Option<usize>,
}

const JOINTS: &str = "joint states (sensor_msgs/JointState)";
const DESCRIPTION: &str = "a robot description (std_msgs/String)";
const PICTURES: &str = "pictures (sensor_msgs/Image)";
const MASKS: &str = "masks of the arm (sensor_msgs/Image)";

/// What pictures for people are to a recording.
pub(super) const COLOR: &str = "color";

impl Chosen {
    /// The topics that `options` name, else the only ones that can be meant; `known_background` is
    /// what the bag itself names so. `path` is for messages.
    pub(super) fn new(
        path: &Path,
        scan: &Scan,
        options: &BagOptions,
        known_background: Option<&str>,
    ) -> Result<Self, RecordingError> {
        let candidates = Candidates { path, topics: &scan.topics };
        let wanted =
            |input, what, name| Wanted { by: By::Input(input), what, name: Option::as_deref(name) };
        let background = depth::background(&candidates, options, known_background)?;
        let range = depth::range(&candidates, options.depth_topic.as_deref(), background)?;
        let joints = wanted(Input::JOINT_TOPIC, JOINTS, &options.joint_topic);
        let joints = candidates.needed(joints, &is_joints)?;
        let depth = scan.topic(range);
        let camera_info = match options.camera_info {
            Some(_) => None,
            None => depth::camera_info(&candidates, options.camera_info_topic.as_deref(), depth)?,
        };
        // Of pictures that do not tell their size themselves, the intrinsics do.
        let depth_size = size(depth).or(camera_info.and_then(|info| size(scan.topic(info))));
        // What shows the same as the depth, pixel by pixel.
        let beside =
            |topic: &TopicScan| size(topic) == depth_size && topic.frame_id == depth.frame_id;
        let picture = |topic: &TopicScan| encoding(topic).is_some();
        let color = match &options.color_topic {
            None => candidates.only(&|topic| is_color(topic) && beside(topic)),
            name => candidates.one(wanted(Input::COLOR_TOPIC, PICTURES, name), &picture)?,
        };
        let mask = match &options.mask_topic {
            None => candidates
                .one(wanted(Input::MASK_TOPIC, MASKS, &None), &|t| is_mask(t) && beside(t))?,
            name => candidates.one(wanted(Input::MASK_TOPIC, PICTURES, name), &picture)?,
        };
        let description = wanted(Input::DESCRIPTION_TOPIC, DESCRIPTION, &options.description_topic);
        let description = candidates.one(description, &is_description)?;
        let chosen = Self { range, camera_info, joints, description, color, mask, background };
        for (number, role) in chosen.roles() {
            tracing::debug!(role, topic = scan.topic(number).name, "topic chosen");
        }
        Ok(chosen)
    }

    /// The topics, with what each is to the recording.
    pub(super) fn roles(&self) -> impl Iterator<Item = (usize, &'static str)> + use<> {
        let Self { range, camera_info, joints, description, color, mask, background } = *self;
        let roles = [
            (Some(range), "depth"),
            (Some(joints), "joints"),
            (camera_info, "intrinsics"),
            (description, "robot"),
            (color, COLOR),
            (mask, "mask"),
            (background, "background"),
        ];
        roles.into_iter().filter_map(|(number, role)| Some((number?, role)))
    }

    /// What topic `number` is to the recording.
    pub(super) fn role(&self, number: usize) -> Option<&'static str> {
        self.roles().find(|(chosen, _)| *chosen == number).map(|(_, role)| role)
    }
}
