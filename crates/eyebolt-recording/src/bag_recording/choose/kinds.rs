//! What a topic may be to a recording, by its type, its name and its pictures.

use crate::bag_recording::scan::{Content, PictureKind, TopicScan};
use crate::message::types;

/// Pictures of one byte a pixel.
const GREY: [&str; 2] = ["mono8", "8UC1"];
const COLORS: [&str; 4] = ["rgb8", "bgr8", "rgba8", "bgra8"];

/// Name of the compressed form of a topic, below it.
pub(super) const COMPRESSED: &str = "/compressedDepth";

fn pictures(topic: &TopicScan) -> Option<&PictureKind> {
    match &topic.content {
        Content::Pictures(pictures) => Some(&pictures.kind),
        _ => None,
    }
}

/// The encoding of its pictures, if they are not compressed.
pub(super) fn encoding(topic: &TopicScan) -> Option<&str> {
    match pictures(topic)? {
        PictureKind::Image { encoding, .. } => Some(encoding),
        _ => None,
    }
}

pub(super) fn is_mask(topic: &TopicScan) -> bool {
    topic.name.ends_with("mask") && encoding(topic).is_some_and(|e| GREY.contains(&e))
}

pub(super) fn is_color(topic: &TopicScan) -> bool {
    encoding(topic).is_some_and(|encoding| COLORS.contains(&encoding)) || is_compressed_color(topic)
}

pub(super) fn is_compressed_color(topic: &TopicScan) -> bool {
    matches!(pictures(topic), Some(PictureKind::CompressedColor))
}

pub(super) fn is_cloud(topic: &TopicScan) -> bool {
    matches!(pictures(topic), Some(PictureKind::Cloud { .. }))
}

pub(super) fn is_depth_image(topic: &TopicScan) -> bool {
    topic.message_type != types::CLOUD && rank(topic).is_some()
}

pub(super) fn is_joints(topic: &TopicScan) -> bool {
    !topic.tracks().is_empty()
}

pub(super) fn is_description(topic: &TopicScan) -> bool {
    topic.name.ends_with("robot_description")
        && matches!(&topic.content, Content::Text(text) if !text.is_empty())
}

pub(super) fn is_intrinsics(topic: &TopicScan) -> bool {
    matches!(&topic.content, Content::CameraInfo { first, .. } if first.is_some())
}

/// Size of its pictures, or of those that it tells the intrinsics of.
pub(crate) fn size(topic: &TopicScan) -> Option<(u32, u32)> {
    match &topic.content {
        Content::Pictures(pictures) => match &pictures.kind {
            PictureKind::Image { size, .. } | PictureKind::Cloud { size } => Some(*size),
            _ => pictures.compressed_size,
        },
        Content::CameraInfo { first, .. } => first.as_ref().map(|first| first.sizes()[1]),
        _ => None,
    }
}

/// Whether intrinsics may be of pictures of that size.
pub(super) fn may_be_of(topic: &TopicScan, size: (u32, u32)) -> bool {
    match &topic.content {
        Content::CameraInfo { first: Some(first), .. } => first.sizes().contains(&size),
        _ => false,
    }
}

/// How well distances can be read from it, 0 the best; `None` if they cannot.
pub(super) fn rank(topic: &TopicScan) -> Option<u8> {
    pictures(topic)?.range_rank()
}

/// Pictures of one number a pixel that are no depth.
pub(super) fn is_no_depth(name: &str) -> bool {
    name.contains("confidence") || name.contains("disparity")
}

/// The topic of the picture that `topic` has, compressed or not.
fn picture_of(topic: &str) -> &str {
    topic.strip_suffix(COMPRESSED).unwrap_or(topic)
}

/// Whether the pictures of a topic are rectified. By ROS's convention, these have a word for it in
/// their name, and clouds are made of them.
pub(crate) fn is_rectified(topic: &TopicScan) -> bool {
    let mut words = picture_of(&topic.name).rsplit('/').next().unwrap_or_default().split('_');
    topic.message_type == types::CLOUD || words.any(|w| matches!(w, "rect" | "rectified"))
}

/// Where drivers publish the intrinsics of a topic of pictures, or of its compressed form.
pub(super) fn siblings(topic: &str) -> Vec<String> {
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
