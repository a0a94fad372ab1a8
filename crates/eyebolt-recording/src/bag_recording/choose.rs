//! Which topics of a bag are the recording.

use super::BagOptions;
use super::scan::{Content, PictureKind, Scan, TopicScan};
use crate::error::RecordingError;
use crate::message::types;
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

impl Chosen {
    /// The topics that `options` name, else the only ones that can be meant; `known_background` is
    /// what the bag itself names so.
    pub(super) fn new(
        path: &Path,
        scan: &Scan,
        options: &BagOptions,
        known_background: Option<&str>,
    ) -> Result<Self, RecordingError> {
        let choice = Choice { path, scan };
        let background = choice.background(options, known_background)?;
        let range = choice.range(options.depth_topic.as_deref(), background)?;
        let joints = choice.one(
            "--joint-topic",
            "joint states (sensor_msgs/JointState)",
            options.joint_topic.as_deref(),
            &|topic| matches!(&topic.content, Content::Joints(joints) if !joints.tracks().is_empty()),
        )?;
        let Some(joints) = joints else {
            return Err(choice.none("--joint-topic", "joint states (sensor_msgs/JointState)"));
        };
        let camera_info = match options.camera_info {
            Some(_) => None,
            None => choice.camera_info(options.camera_info_topic.as_deref(), range)?,
        };
        let info_size = camera_info.and_then(|number| size(scan.topics.get(number)?));
        let beside = choice.beside(range, info_size);
        let color = match options.color_topic.as_deref() {
            None => choice.only(&|topic| is_color(topic) && beside(topic)),
            wanted => choice.one("--color-topic", PICTURES, wanted, &|t| encoding(t).is_some())?,
        };
        let mask = match options.mask_topic.as_deref() {
            None => choice.one("--mask-topic", MASKS, None, &|t| is_mask(t) && beside(t))?,
            wanted => choice.one("--mask-topic", PICTURES, wanted, &|t| encoding(t).is_some())?,
        };
        let description = choice.one(
            "--description-topic",
            "a robot description (std_msgs/String)",
            options.description_topic.as_deref(),
            &|topic| {
                topic.name.ends_with("robot_description")
                    && matches!(&topic.content, Content::Text(text) if !text.is_empty())
            },
        )?;
        Ok(Self { range, camera_info, joints, description, color, mask, background })
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
}

/// What pictures for people are to a recording.
pub(super) const COLOR: &str = "color";

/// Pictures of one byte a pixel.
const GREY: [&str; 2] = ["mono8", "8UC1"];
const COLORS: [&str; 4] = ["rgb8", "bgr8", "rgba8", "bgra8"];

fn encoding(topic: &TopicScan) -> Option<&str> {
    match &topic.content {
        Content::Pictures(pictures) => match &pictures.kind {
            PictureKind::Image { encoding, .. } => Some(encoding),
            _ => None,
        },
        _ => None,
    }
}

const PICTURES: &str = "pictures (sensor_msgs/Image)";
const MASKS: &str = "masks of the arm (sensor_msgs/Image)";

fn is_mask(topic: &TopicScan) -> bool {
    topic.name.ends_with("mask") && encoding(topic).is_some_and(|e| GREY.contains(&e))
}

fn is_color(topic: &TopicScan) -> bool {
    encoding(topic).is_some_and(|encoding| COLORS.contains(&encoding))
}

fn size(topic: &TopicScan) -> Option<(u32, u32)> {
    match &topic.content {
        Content::Pictures(pictures) => match &pictures.kind {
            PictureKind::Image { size, .. } | PictureKind::Cloud { size } => Some(*size),
            _ => None,
        },
        Content::CameraInfo { first, .. } => first.as_ref().map(super::scan::Intrinsics::size),
        _ => None,
    }
}

fn rank(topic: &TopicScan) -> Option<u8> {
    match &topic.content {
        Content::Pictures(pictures) => pictures.kind.range_rank(),
        _ => None,
    }
}

const BACKGROUND: &str = "--background-topic";
const BACKGROUNDS: &str = "depth images (Image in 16UC1 or 32FC1, or compressedDepth)";

fn is_depth_image(topic: &TopicScan) -> bool {
    topic.message_type != types::CLOUD && rank(topic).is_some()
}

/// Name of the compressed form of a topic, below it.
const COMPRESSED: &str = "/compressedDepth";

/// The topic of the picture that `topic` has, compressed or not.
pub(super) fn picture_of(topic: &str) -> &str {
    topic.strip_suffix(COMPRESSED).unwrap_or(topic)
}

/// Pictures of one number a pixel that are no depth.
fn is_no_depth(name: &str) -> bool {
    name.contains("confidence") || name.contains("disparity")
}

struct Choice<'a> {
    path: &'a Path,
    scan: &'a Scan,
}

impl Choice<'_> {
    /// The topic of depth of the scene without the robot: the one that a flag names, else the one
    /// that the bag does, unless a flag names that as the depth of the recording.
    fn background(
        &self,
        options: &BagOptions,
        known: Option<&str>,
    ) -> Result<Option<usize>, RecordingError> {
        let depth = options.depth_topic.as_deref();
        if let Some(wanted) = options.background_topic.as_deref() {
            if depth == Some(wanted) {
                let problem = format!("{wanted} is the topic of the depth too");
                let remedy = "Give two topics, or leave one of the flags out";
                return Err(RecordingError::invalid(self.path, BACKGROUND, problem, remedy));
            }
            return self.one(BACKGROUND, BACKGROUNDS, Some(wanted), &is_depth_image);
        }
        let Some(known) = known.filter(|known| depth != Some(*known)) else { return Ok(None) };
        let found =
            self.one("metadata: background_topic", BACKGROUNDS, Some(known), &is_depth_image);
        // Its messages may be what got lost.
        if options.partial { Ok(found.unwrap_or(None)) } else { found }
    }

    fn range(
        &self,
        wanted: Option<&str>,
        background: Option<usize>,
    ) -> Result<usize, RecordingError> {
        let what = "depth (Image in 16UC1 or 32FC1, compressedDepth, or PointCloud2)";
        let background = background.and_then(|number| Some(&self.scan.topics.get(number)?.name));
        let is_no_depth = |name: &String| is_no_depth(name) || Some(name) == background;
        // A camera's depth image is often recorded beside the cloud that was made of it.
        let topics = || self.scan.topics.iter().filter(|topic| !is_no_depth(&topic.name));
        let best = topics().filter_map(rank).min();
        // And beside its compressed form.
        let twice = |topic: &TopicScan| {
            let raw = topic.name.strip_suffix(COMPRESSED);
            raw.is_some_and(|raw| topics().any(|t| t.name == raw && rank(t) == best))
        };
        let fits = |topic: &TopicScan| match wanted {
            Some(_) => rank(topic).is_some(),
            None => {
                rank(topic).is_some()
                    && rank(topic) == best
                    && !is_no_depth(&topic.name)
                    && !twice(topic)
            }
        };
        let found = self.one("--depth-topic", what, wanted, &fits)?;
        found.ok_or_else(|| self.none("--depth-topic", what))
    }

    /// The topic called `wanted`, else the only one that `fits`.
    fn one(
        &self,
        flag: &str,
        what: &str,
        wanted: Option<&str>,
        fits: &dyn Fn(&TopicScan) -> bool,
    ) -> Result<Option<usize>, RecordingError> {
        let topics = || self.scan.topics.iter().enumerate();
        if let Some(wanted) = wanted {
            let found = topics().find(|(_, topic)| topic.name == wanted);
            return match found {
                Some((number, topic)) if fits(topic) => Ok(Some(number)),
                Some((_, topic)) => {
                    let problem = format!(
                        "{wanted} is of type {} and has no {what} that can be read",
                        topic.message_type
                    );
                    Err(RecordingError::invalid(self.path, flag, problem, self.candidates(fits)))
                }
                None => {
                    let problem = format!("there is no topic {wanted}");
                    Err(RecordingError::invalid(self.path, flag, problem, self.candidates(fits)))
                }
            };
        }
        let mut found = topics().filter(|(_, topic)| fits(topic)).map(|(number, _)| number);
        match (found.next(), found.next()) {
            (Some(_), Some(_)) => {
                let problem = format!("several topics have {what}");
                Err(RecordingError::invalid(self.path, flag, problem, self.candidates(fits)))
            }
            (found, _) => Ok(found),
        }
    }

    /// Says which topics could be meant.
    fn candidates(&self, fits: &dyn Fn(&TopicScan) -> bool) -> String {
        let fitting: Vec<_> =
            self.scan.topics.iter().filter(|t| fits(t)).map(|t| t.name.as_str()).collect();
        match fitting.is_empty() {
            true => format!("There is none that would do; the bag has {}", self.all()),
            false => format!("Give one of {}", fitting.join(", ")),
        }
    }

    fn none(&self, flag: &str, what: &str) -> RecordingError {
        let remedy = format!("Record it too; the bag has {}", self.all());
        RecordingError::invalid(self.path, flag, format!("no topic has {what}"), remedy)
    }

    fn all(&self) -> String {
        let topics = self.scan.topics.iter();
        let names: Vec<_> = topics.map(|t| format!("{} ({})", t.name, t.message_type)).collect();
        if names.is_empty() { "no messages at all".to_owned() } else { names.join(", ") }
    }

    /// The camera of the depth topic: beside it by ROS's convention, else the only one of its size
    /// and frame.
    fn camera_info(
        &self,
        wanted: Option<&str>,
        range: usize,
    ) -> Result<Option<usize>, RecordingError> {
        let flag = "--camera-info-topic";
        let what = "the intrinsics (sensor_msgs/CameraInfo)";
        let infos = |topic: &TopicScan| matches!(&topic.content, Content::CameraInfo { first, .. } if first.is_some());
        if wanted.is_some() {
            return self.one(flag, what, wanted, &infos);
        }
        let Some(depth) = self.scan.topics.get(range) else { return Ok(None) };
        let beside = siblings(&depth.name).into_iter().find_map(|name| {
            self.scan.topics.iter().position(|topic| topic.name == name && infos(topic))
        });
        if beside.is_some() {
            return Ok(beside);
        }
        let same = |topic: &TopicScan| {
            infos(topic)
                && (size(depth).is_none() || size(topic) == size(depth))
                && (depth.frame_id.is_none() || topic.frame_id == depth.frame_id)
        };
        let found = self.one(flag, what, None, &same)?;
        // Clouds tell their camera themselves, if they have one.
        let cloud = matches!(&depth.content, Content::Pictures(p) if matches!(p.kind, PictureKind::Cloud { .. }));
        match found {
            None if !cloud => {
                let problem = format!("no topic has the intrinsics of {}", depth.name);
                let remedy = format!(
                    "Record its camera_info, or give it as a file with --camera-info. {}",
                    self.candidates(&infos)
                );
                Err(RecordingError::invalid(self.path, flag, problem, remedy))
            }
            found => Ok(found),
        }
    }

    /// Whether a topic shows what the depth shows, pixel by pixel; `info_size` is the size of the
    /// depth where its own messages do not tell.
    fn beside(&self, range: usize, info_size: Option<(u32, u32)>) -> impl Fn(&TopicScan) -> bool {
        let depth = self.scan.topics.get(range);
        let depth_size = depth.and_then(size).or(info_size);
        move |topic| {
            size(topic) == depth_size && depth.is_some_and(|depth| topic.frame_id == depth.frame_id)
        }
    }

    /// The only topic that `fits`. Colour is for people: among several, none is better than the
    /// wrong one.
    fn only(&self, fits: &dyn Fn(&TopicScan) -> bool) -> Option<usize> {
        let mut fitting = self.scan.topics.iter().enumerate().filter(|(_, topic)| fits(topic));
        let found = fitting.next().map(|(number, _)| number);
        found.filter(|_| fitting.next().is_none())
    }
}

/// Where drivers publish the intrinsics of a topic of pictures, or of its compressed form.
fn siblings(topic: &str) -> Vec<String> {
    let above = |name: &str| name.rsplit_once('/').map(|(above, _)| above.to_owned());
    let picture = topic.strip_suffix(COMPRESSED);
    let folders = [above(topic), picture.and_then(above)];
    folders.into_iter().flatten().map(|folder| format!("{folder}/camera_info")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intrinsics_are_beside_the_picture() {
        assert_eq!(siblings("/zed/depth/depth_registered"), ["/zed/depth/camera_info"]);
        assert_eq!(siblings("/cam/image_raw/compressedDepth")[1], "/cam/camera_info");
        assert_eq!(siblings("/depth"), ["/camera_info"]);
    }
}
