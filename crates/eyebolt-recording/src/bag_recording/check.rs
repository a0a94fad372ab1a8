//! What is wrong with a topic that the recording needs is wrong with the recording.

use super::choose::{COLOR, COLOR_INFO, Chosen};
use super::pair::Paired;
use super::scan::{Content, Scan, TopicScan};
use crate::error::RecordingError;
use crate::joints::{self, looks_like_degrees};
use eyebolt_robot::Input;
use std::path::Path;

/// One stamp of so many may run backward: networks deliver some messages out of order.
const MOST_BACKWARD: u64 = 100;

/// Messages, stamps and intrinsics of the topics that are needed. With `partial`, messages may be
/// damaged.
pub(super) fn check_topics(
    path: &Path,
    scan: &Scan,
    chosen: &Chosen,
    partial: bool,
) -> Result<(), RecordingError> {
    // Colour is for people only, who do without some pictures.
    let of_colour = |role: &str| [COLOR, COLOR_INFO].contains(&role);
    for (number, _) in chosen.roles().filter(|(_, role)| !of_colour(role)) {
        let topic = scan.topic(number);
        if !partial {
            check_messages(path, topic)?;
        }
        check_stamps(path, topic)?;
    }
    let Some(topic) = chosen.camera_info.map(|number| scan.topic(number)) else { return Ok(()) };
    let Content::CameraInfo { changed_ns: Some(changed), .. } = &topic.content else {
        return Ok(());
    };
    let problem = format!("the intrinsics change at {}", seconds(*changed));
    let remedy = format!(
        "Record with one setting of the camera, or give {} with a file",
        Input::CAMERA_INFO
    );
    Err(RecordingError::invalid(path, &topic.name, problem, remedy))
}

fn check_messages(path: &Path, topic: &TopicScan) -> Result<(), RecordingError> {
    let Some((log_time_ns, wrong)) = &topic.first_problem else { return Ok(()) };
    let field = format!("{}: {}", topic.name, wrong.field);
    let problem = format!("{} (message of {})", wrong.problem, seconds(*log_time_ns));
    let remedy = format!("Record it again, or give {} to go without such messages", Input::PARTIAL);
    Err(RecordingError::invalid(path, field, problem, remedy))
}

fn check_stamps(path: &Path, topic: &TopicScan) -> Result<(), RecordingError> {
    let (backward, Some((latest, next))) = topic.backward() else { return Ok(()) };
    if backward <= (topic.count / MOST_BACKWARD).max(1) {
        return Ok(());
    }
    let problem = format!(
        "{backward} of {} stamps run backward, first from {} to {}",
        topic.count,
        seconds(latest),
        seconds(next)
    );
    let remedy = "Two programs publish there, or the clock was set back: record it again";
    Err(RecordingError::invalid(path, &topic.name, problem, remedy))
}

/// Backgrounds are depth images, for which there must be a camera.
pub(super) fn check_background(
    path: &Path,
    scan: &Scan,
    chosen: &Chosen,
    has_camera: bool,
) -> Result<(), RecordingError> {
    let Some(number) = chosen.background.filter(|_| !has_camera) else { return Ok(()) };
    let problem = "a background is a depth image, and the recording has no camera for it";
    let remedy = format!(
        "Give the intrinsics with {}, or record clouds without backgrounds",
        Input::CAMERA_INFO
    );
    Err(RecordingError::invalid(path, &scan.topic(number).name, problem, remedy))
}

/// Joints in degrees would put the arm anywhere; `topic` is where they were told.
pub(super) fn check_joints(
    path: &Path,
    topic: &TopicScan,
    paired: &Paired,
) -> Result<(), RecordingError> {
    let farthest = |joint: usize| {
        let positions = paired.kept.iter().filter_map(|kept| kept.positions.get(joint));
        let told = positions.copied().filter(|position| !position.is_nan());
        told.max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(0.0)
    };
    let joints = paired.names.iter().enumerate().map(|(joint, name)| (name, farthest(joint)));
    let suspects: Vec<_> = joints.filter(|(_, far)| looks_like_degrees(*far)).collect();
    // Wheels, which a topic may tell of too, do turn so far; they are the lesser part.
    match suspects.first() {
        Some((name, position)) if 2 * suspects.len() >= paired.names.len() => {
            joints::check(path, &topic.name, "", name, *position)
        }
        _ => Ok(()),
    }
}

fn seconds(ns: i64) -> String {
    format!("{:.3} s", ns as f64 * 1e-9)
}
