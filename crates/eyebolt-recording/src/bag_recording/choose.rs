//! Which topics of a bag are the recording.

mod candidates;
mod depth;
mod joints;
mod kinds;
mod recommended;

pub(super) use kinds::{is_rectified, size};

use super::frames::between;
use super::options::BagOptions;
use super::scan::{Scan, TopicScan};
use crate::error::RecordingError;
use crate::message::types;
use crate::provenance::DepthChoice;
use candidates::{By, Candidates, Wanted};
use eyebolt_robot::Input;
use kinds::{
    encoding, is_cloud, is_color, is_compressed_color, is_description, is_intrinsics, is_joints,
    is_mask, siblings,
};
use std::path::Path;

/// Numbers of topics in a scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Chosen {
    pub(super) range: usize,
    pub(super) camera_info: Option<usize>,
    pub(super) joints: usize,
    pub(super) description: Option<usize>,
    pub(super) color: Option<usize>,
    /// Intrinsics of the colour, where it is of another camera than the depth.
    pub(super) color_info: Option<usize>,
    pub(super) mask: Option<usize>,
    pub(super) background: Option<usize>,
    /// Why `range` was taken, which nobody named, where several could be meant.
    pub(super) depth_choice: Option<DepthChoice>,
}

/// What is looked for, and the types of its messages.
type Kind = (&'static str, &'static [&'static str]);

const JOINTS: Kind = ("joint states (sensor_msgs/JointState)", &[types::JOINT_STATE]);
const DESCRIPTION: Kind = ("a robot description (std_msgs/String)", &[types::STRING]);
const PICTURES: Kind = ("pictures (sensor_msgs/Image)", &[types::IMAGE]);
const COLORS: Kind = (
    "pictures (sensor_msgs/Image, or CompressedImage in JPEG or PNG)",
    &[types::IMAGE, types::COMPRESSED_IMAGE],
);
const MASKS: Kind = ("masks of the arm (sensor_msgs/Image)", &[types::IMAGE]);

/// What pictures for people are to a recording.
pub(super) const COLOR: &str = "color";
/// The intrinsics of these, where they are of another camera.
pub(super) const COLOR_INFO: &str = "color camera";

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
        check_any(path, scan)?;
        let wanted = |input, (what, types), name| Wanted {
            by: By::Input(input),
            what,
            types,
            name: Option::as_deref(name),
        };
        let background = depth::background(&candidates, options, known_background)?;
        let (range, depth_choice) = depth::range(&candidates, options, background)?;
        let description = wanted(Input::DESCRIPTION_TOPIC, DESCRIPTION, &options.description_topic);
        let joints = wanted(Input::JOINT_TOPIC, JOINTS, &options.joint_topic);
        let joints = match candidates.needed(joints, &is_joints) {
            // Grippers and other arms tell theirs elsewhere.
            Err(several) if options.joint_topic.is_none() => {
                let known = candidates.one(description, &is_description).ok().flatten();
                let of_robot = joints::of_robot(options, &scan.topics, known);
                joints::telling_most(&scan.topics, &of_robot).ok_or(several)?
            }
            found => found?,
        };
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
        // Of another camera whose place beside this one is known: its intrinsics.
        let other = |topic: &TopicScan| other_camera(scan, depth, topic);
        let picture = |topic: &TopicScan| encoding(topic).is_some();
        let color = match &options.color_topic {
            None => {
                let fits = |topic: &TopicScan| is_color(topic) && beside(topic);
                // The same pictures are often recorded compressed as well.
                let only = |fits: &dyn Fn(&TopicScan) -> bool| {
                    let raw = candidates.only(&|topic| fits(topic) && picture(topic));
                    raw.or_else(|| candidates.only(fits))
                };
                let elsewhere = |topic: &TopicScan| is_color(topic) && other(topic).is_some();
                only(&fits).or_else(|| only(&elsewhere))
            }
            name => {
                let color = |topic: &TopicScan| picture(topic) || is_compressed_color(topic);
                candidates.one(wanted(Input::COLOR_TOPIC, COLORS, name), &color)?
            }
        };
        let mask = match &options.mask_topic {
            None => candidates
                .one(wanted(Input::MASK_TOPIC, MASKS, &None), &|t| is_mask(t) && beside(t))?,
            name => candidates.one(wanted(Input::MASK_TOPIC, PICTURES, name), &picture)?,
        };
        let description = candidates.one(description, &is_description)?;
        let color_info = color.and_then(|number| other(scan.topic(number)));
        let named_color = color.filter(|_| options.color_topic.is_some() && color_info.is_none());
        let by_name = [
            (Input::COLOR_TOPIC, named_color),
            (Input::BACKGROUND_TOPIC, background.filter(|_| options.background_topic.is_some())),
        ];
        for (input, number) in by_name {
            check_size(&candidates, input, number, depth_size)?;
        }
        let chosen = Self {
            range,
            camera_info,
            joints,
            description,
            color,
            color_info,
            mask,
            background,
            depth_choice,
        };
        for (number, role) in chosen.roles() {
            tracing::debug!(role, topic = scan.topic(number).name, "topic chosen");
        }
        Ok(chosen)
    }

    /// The topics, with what each is to the recording.
    pub(super) fn roles(&self) -> impl Iterator<Item = (usize, &'static str)> + use<> {
        let Self { range, camera_info, joints, description, color, color_info, .. } = *self;
        let Self { mask, background, .. } = *self;
        let roles = [
            (Some(range), "depth"),
            (Some(joints), "joints"),
            (camera_info, "intrinsics"),
            (description, "robot"),
            (color, COLOR),
            (color_info, COLOR_INFO),
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

/// The topic of the intrinsics of `color`, if its pictures are of another camera than `depth` and
/// `/tf_static` connects the two.
fn other_camera(scan: &Scan, depth: &TopicScan, color: &TopicScan) -> Option<usize> {
    let (near, far) = (depth.frame_id.as_deref()?, color.frame_id.as_deref()?);
    if near == far || is_cloud(depth) {
        return None;
    }
    between(&scan.static_transforms, far, near)?;
    let name = color.name.strip_suffix("/compressed").unwrap_or(&color.name);
    let beside = siblings(name);
    scan.topics.iter().position(|topic| is_intrinsics(topic) && beside.contains(&topic.name))
}

/// Says that nothing was recorded at all.
fn check_any(path: &Path, scan: &Scan) -> Result<(), RecordingError> {
    if !scan.topics.is_empty() {
        return Ok(());
    }
    let problem = "it is empty: no topic has depth or joint states, there are no messages at all";
    let remedy = "Record again, and look with `ros2 topic hz` whether the topics are published \
                  where you record, by the same ROS_DOMAIN_ID";
    Err(RecordingError::invalid(path, "the bag", problem, remedy))
}

/// Says that the pictures of topic `number`, which `input` names, are not of the depth's size.
fn check_size(
    candidates: &Candidates<'_>,
    input: Input,
    number: Option<usize>,
    depth_size: Option<(u32, u32)>,
) -> Result<(), RecordingError> {
    let topic = number.and_then(|number| candidates.topics.get(number));
    let sizes = topic.and_then(|topic| Some((topic, size(topic)?, depth_size?)));
    match sizes.filter(|(_, size, depth)| size != depth) {
        None => Ok(()),
        Some((topic, (width, height), (w, h))) => {
            let problem = format!("{} is {width} x {height}, the depth {w} x {h}", topic.name);
            let remedy = match input {
                Input::COLOR_TOPIC => {
                    "Give a topic whose pixels are those of the depth, or record the camera_info of \
                     this one and /tf_static too"
                }
                _ => "Give a topic whose pixels are those of the depth",
            };
            Err(candidates.invalid(By::Input(input), problem, remedy))
        }
    }
}
