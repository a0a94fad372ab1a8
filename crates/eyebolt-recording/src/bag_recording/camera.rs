//! The camera of a bag.

use super::choose::{Chosen, is_rectified, size};
use super::options::BagOptions;
use super::scan::{Content, Scan};
use crate::bag::Bag;
use crate::camera_info::{CameraInfo, PictureForm};
use crate::error::RecordingError;
use crate::message::{CameraInfoMessage, WireReader};
use eyebolt_robot::Input;
use std::path::Path;

/// The camera, from the file that an option names or from its topic.
pub(super) fn read_camera(
    path: &Path,
    bag: &Bag,
    scan: &Scan,
    chosen: &Chosen,
    options: &BagOptions,
) -> Result<Option<CameraInfo>, RecordingError> {
    let depth = scan.topic(chosen.range);
    let picture = PictureForm { rectified: is_rectified(depth), size: size(depth) };
    if let Some(path) = &options.camera_info {
        return CameraInfo::read_for(path, picture).map(Some);
    }
    let Some(topic) = chosen.camera_info.map(|number| scan.topic(number)) else { return Ok(None) };
    let Content::CameraInfo { locator: Some(locator), .. } = &topic.content else {
        return Ok(None);
    };
    let bytes = bag.read(*locator)?;
    let message = WireReader::new(&topic.encoding, &bytes)
        .and_then(|mut reader| CameraInfoMessage::read(&mut reader))
        .map_err(|wrong| {
            let field = format!("{}: {}", topic.name, wrong.field);
            RecordingError::invalid(path, field, wrong.problem, "Record it again")
        })?;
    let info = CameraInfo::from_message(path, &message, picture);
    info.map(Some).map_err(|error| match error {
        RecordingError::Invalid { field, problem, .. } => {
            let remedy = format!(
                "Give another topic with {}, or a file with {}",
                Input::CAMERA_INFO_TOPIC,
                Input::CAMERA_INFO
            );
            RecordingError::invalid(path, format!("{}: {field}", topic.name), problem, remedy)
        }
        other => other,
    })
}
