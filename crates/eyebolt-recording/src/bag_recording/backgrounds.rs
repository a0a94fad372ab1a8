//! Depth of the scene without the robot.

use super::BagRecording;
use super::scan::{Content, FrameEntry, Scan, Unfit};
use crate::error::RecordingError;
use crate::frame_source::FrameSource;
use eyebolt_geometry::DepthImage;

impl BagRecording {
    /// Reads background `index`, counted from 0 in order of time: depth of the camera's size in
    /// metres, 0 where there is none.
    ///
    /// # Errors
    ///
    /// No such background; a message that cannot be read, does not fit the camera or cannot be in
    /// its unit.
    pub(super) fn background(&self, index: usize) -> Result<DepthImage, RecordingError> {
        let (number, entry) =
            self.chosen.background.zip(self.backgrounds.get(index)).ok_or_else(|| {
                let (path, count) = (self.path.clone(), self.background_count());
                RecordingError::NoSuchBackground { path, index, count }
            })?;
        self.depth_image(self.topic(number), entry)
    }

    /// Backgrounds are depth images, for which there must be a camera.
    pub(super) fn check_background(&self) -> Result<(), RecordingError> {
        let Some(number) = self.chosen.background.filter(|_| self.camera.is_none()) else {
            return Ok(());
        };
        let problem = "a background is a depth image, and the recording has no camera for it";
        let remedy = "Give the intrinsics with --camera-info, or record clouds without backgrounds";
        Err(self.invalid(&self.topic(number).name, problem.to_owned(), remedy))
    }
}

/// The images that can be read, sorted by stamp: those without any depth too, since a scene may
/// well be out of the camera's range.
pub(super) fn backgrounds(scan: &Scan, topic: Option<usize>) -> Vec<FrameEntry> {
    let content = topic.and_then(|number| Some(&scan.topics.get(number)?.content));
    let Some(Content::Pictures(pictures)) = content else { return Vec::new() };
    let readable = |entry: &&FrameEntry| !matches!(entry.unfit, Some(Unfit::Unreadable(_)));
    let mut sorted: Vec<_> = pictures.frames.iter().filter(readable).cloned().collect();
    sorted.sort_by_key(|entry| entry.stamp_ns);
    sorted
}
