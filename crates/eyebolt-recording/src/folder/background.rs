//! Depth of the scene without the robot, from its files.

use super::{Folder, none_fits};
use crate::depth::read_any_depth;
use crate::error::RecordingError;
use crate::manifest::{Background, Manifest, Unit};
use eyebolt_geometry::DepthImage;
use std::collections::BTreeSet;

impl Folder {
    /// Number of depth images of the scene without the robot.
    pub fn background_count(&self) -> usize {
        self.backgrounds.len()
    }

    /// Reads background `index`, counted from 0 in the order of their names: depth of the camera's
    /// size in metres, 0 where there is none.
    ///
    /// # Errors
    ///
    /// No such background; a file that cannot be read, is damaged, is not of the camera's size or
    /// cannot be in the unit claimed.
    pub fn read_background(&self, index: usize) -> Result<DepthImage, RecordingError> {
        let info = self.camera_text();
        let found = self.manifest.background.as_ref().zip(self.backgrounds.get(index));
        let Some(((background, name), camera)) = found.zip(self.camera_size(&info)) else {
            let (path, count) = (self.manifest.path.clone(), self.background_count());
            return Err(RecordingError::NoSuchBackground { path, index, count });
        };
        let Background { files, unit } = background;
        read_any_depth(&files.path(name), files.extension(), *unit, camera)
    }

    /// Whether backgrounds are stored in whole millimetres.
    pub(crate) fn backgrounds_in_millimetres(&self) -> bool {
        self.manifest.background.as_ref().is_some_and(|background| {
            background.unit == Unit::Millimetres && background.files.extension() == "png"
        })
    }
}

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
