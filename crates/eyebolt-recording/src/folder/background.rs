//! Which files of a folder are depth of the scene without the robot.

use super::none_fits::none_fits;
use crate::error::RecordingError;
use crate::manifest::{Background, Manifest};
use std::collections::BTreeSet;

/// Names of the backgrounds, which are no frames.
pub(super) fn names(manifest: &Manifest, frames: &[String]) -> Result<Vec<String>, RecordingError> {
    const FIELD: &str = "background.depth";
    let Some(Background { files, .. }) = &manifest.background else { return Ok(Vec::new()) };
    let names = files.frames(FIELD)?;
    if names.is_empty() {
        return Err(none_fits(&manifest.path, FIELD, files));
    }
    let of_frames: BTreeSet<_> = frames.iter().map(|name| manifest.range.path(name)).collect();
    if let Some(both) = names.iter().map(|name| files.path(name)).find(|p| of_frames.contains(p)) {
        let problem = format!("{} is a frame by {} too", both.display(), manifest.range_field());
        let remedy = "Rename the files so that each fits one pattern";
        return Err(RecordingError::invalid(&manifest.path, FIELD, problem, remedy));
    }
    Ok(names)
}
