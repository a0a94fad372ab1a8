//! The topics of depth: of the frames, of the scene without the robot, and of their intrinsics.

use super::candidates::{By, Candidates, Wanted};
use super::kinds::{
    COMPRESSED, is_cloud, is_depth_image, is_intrinsics, is_no_depth, may_be_of, rank, siblings,
    size,
};
use super::recommended;
use crate::bag_recording::options::BagOptions;
use crate::bag_recording::scan::TopicScan;
use crate::error::RecordingError;
use crate::message::types;
use crate::provenance::DepthChoice;
use eyebolt_robot::Input;

const DEPTH: &str = "depth (Image in 16UC1 or 32FC1, compressedDepth, or PointCloud2)";
const BACKGROUNDS: &str = "depth images (Image in 16UC1 or 32FC1, or compressedDepth)";
const INTRINSICS: &str = "the intrinsics (sensor_msgs/CameraInfo)";

/// The topic of depth of the scene without the robot: the one that the options name, else the one
/// that the bag does, unless the options name that as the depth of the recording.
pub(super) fn background(
    candidates: &Candidates<'_>,
    options: &BagOptions,
    known: Option<&str>,
) -> Result<Option<usize>, RecordingError> {
    let depth = options.depth_topic.as_deref();
    let types = &[types::IMAGE, types::COMPRESSED_IMAGE];
    let wanted = |by, name| Wanted { by, what: BACKGROUNDS, types, name: Some(name) };
    if let Some(name) = options.background_topic.as_deref() {
        let by = By::Input(Input::BACKGROUND_TOPIC);
        if depth == Some(name) {
            let problem = format!("{name} is the topic of the depth too");
            return Err(candidates.invalid(by, problem, "Give two topics, or only one of them"));
        }
        return candidates.one(wanted(by, name), &is_depth_image);
    }
    let Some(known) = known.filter(|known| depth != Some(*known)) else { return Ok(None) };
    let by = By::Bag("metadata: background_topic");
    let found = candidates.one(wanted(by, known), &is_depth_image);
    // Its messages may be what got lost.
    if options.partial { Ok(found.unwrap_or(None)) } else { found }
}

/// The topic of the frames; of several the one that they were made of is recommended, and taken if
/// that is allowed.
pub(super) fn range(
    candidates: &Candidates<'_>,
    options: &BagOptions,
    background: Option<usize>,
) -> Result<(usize, Option<DepthChoice>), RecordingError> {
    let name = options.depth_topic.as_deref();
    let background = background.and_then(|number| Some(&candidates.topics.get(number)?.name));
    let is_no_depth = |name: &String| is_no_depth(name) || Some(name) == background;
    // A camera's depth image is often recorded beside the cloud that was made of it.
    let topics = || candidates.topics.iter().filter(|topic| !is_no_depth(&topic.name));
    let best = topics().filter_map(rank).min();
    // And beside its compressed form.
    let twice = |topic: &TopicScan| {
        let raw = topic.name.strip_suffix(COMPRESSED);
        raw.is_some_and(|raw| topics().any(|t| t.name == raw && rank(t) == best))
    };
    let fits = |topic: &TopicScan| match name {
        Some(_) => rank(topic).is_some(),
        None => {
            let good = rank(topic).is_some() && rank(topic) == best;
            good && !is_no_depth(&topic.name) && !twice(topic)
        }
    };
    let fitting = candidates.topics.iter().enumerate().filter(|(_, topic)| fits(topic));
    let names = fitting.clone().map(|(_, topic)| topic.name.as_str());
    let by = By::Input(Input::DEPTH_TOPIC);
    if name.is_none() && names.clone().count() > 1 {
        let raw = recommended::raw(names.clone());
        if options.any_depth {
            let choice = raw.map_or(DepthChoice::First, |_| DepthChoice::Raw);
            let taken = fitting.clone().find(|(_, topic)| raw.is_none_or(|raw| topic.name == raw));
            if let Some((number, _)) = taken {
                return Ok((number, Some(choice)));
            }
        }
        let listed = names.collect::<Vec<_>>().join(", ");
        let problem = format!("several topics have {DEPTH}: {listed}");
        let remedy = match raw {
            Some(raw) => format!("Give {raw}: the others were made of what it has"),
            None => "Give one of them".to_owned(),
        };
        return Err(candidates.invalid(by, problem, remedy));
    }
    let types = &[types::IMAGE, types::COMPRESSED_IMAGE, types::CLOUD];
    let number = candidates.needed(Wanted { by, what: DEPTH, types, name }, &fits)?;
    Ok((number, None))
}

/// The intrinsics of the topic `depth`: beside it by ROS's convention, else the only ones of its
/// size and frame.
pub(super) fn camera_info(
    candidates: &Candidates<'_>,
    name: Option<&str>,
    depth: &TopicScan,
) -> Result<Option<usize>, RecordingError> {
    let by = By::Input(Input::CAMERA_INFO_TOPIC);
    let wanted = Wanted { by, what: INTRINSICS, types: &[types::CAMERA_INFO], name };
    if name.is_some() {
        return candidates.one(wanted, &is_intrinsics);
    }
    let beside = siblings(&depth.name).into_iter().find_map(|name| {
        candidates.topics.iter().position(|topic| topic.name == name && is_intrinsics(topic))
    });
    if beside.is_some() {
        return Ok(beside);
    }
    let same = |topic: &TopicScan| {
        is_intrinsics(topic)
            && size(depth).is_none_or(|size| may_be_of(topic, size))
            && (depth.frame_id.is_none() || topic.frame_id == depth.frame_id)
    };
    match candidates.one(wanted, &same)? {
        // Clouds tell their camera themselves, if they have one.
        None if !is_cloud(depth) => {
            let problem = format!("no topic has the intrinsics of {}", depth.name);
            let remedy = format!(
                "Record its camera_info, or give it as a file with {}. {}",
                Input::CAMERA_INFO,
                candidates.fitting(wanted, &is_intrinsics)
            );
            Err(candidates.invalid(by, problem, remedy))
        }
        found => Ok(found),
    }
}
