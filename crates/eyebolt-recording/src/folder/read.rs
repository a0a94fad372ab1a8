//! Frames of a folder, from their files.

use super::Folder;
use crate::cloud::read_cloud;
use crate::color::{ColorImage, read_color};
use crate::depth::read_depth;
use crate::error::RecordingError;
use crate::frame::{Frame, Range};
use crate::joints::{Joints, read_joints};
use crate::manifest::{CloudFrame, RangeKind};
use crate::mask::read_mask;
use crate::png_image::Expected;
use eyebolt_geometry::{Cloud, Mask};
use eyebolt_robot::JointPositions;
use std::path::Path;

impl Folder {
    /// Reads frame `index`, counted from 0.
    ///
    /// # Errors
    ///
    /// No such frame; a file that cannot be read, is damaged, or does not fit the camera, the
    /// description or the range image; values that cannot be in the unit claimed; a frame that saw
    /// nothing; an empty mask.
    pub fn read_frame(&self, index: usize) -> Result<Frame, RecordingError> {
        let name = self.name(index)?;
        let range = self.range(name)?;
        let mask = self.mask(name, &range)?;
        let joints = self.read_joints(index)?;
        Ok(Frame { name: name.to_owned(), range, mask, joints })
    }

    /// Reads the positions of the joints at frame `index`, counted from 0, and nothing else of it:
    /// radians, metres for prismatic joints.
    ///
    /// # Errors
    ///
    /// No such frame; a file that cannot be read or is damaged; a joint of the description that is
    /// not there, or is there twice; a position that is not finite or cannot be in radians.
    pub fn read_joints(&self, index: usize) -> Result<JointPositions, RecordingError> {
        let name = self.name(index)?;
        match &self.joints {
            Joints::Table(rows) => rows.get(index).cloned().ok_or_else(|| self.no_frame(index)),
            Joints::PerFrame(pattern) => {
                let names = self.manifest.joint_names.as_deref();
                read_joints(&pattern.path(name), pattern.extension(), names)
            }
        }
    }

    /// Reads the colour picture of frame `index`; `None` if the recording has no pictures.
    ///
    /// # Errors
    ///
    /// No such frame; a file that cannot be read, is damaged, or is not of the camera's size.
    pub fn read_color(&self, index: usize) -> Result<Option<ColorImage>, RecordingError> {
        let name = self.name(index)?;
        let Some(pattern) = &self.manifest.color else { return Ok(None) };
        let info = self.camera_text();
        read_color(&pattern.path(name), self.camera_size(&info)).map(Some)
    }

    fn name(&self, index: usize) -> Result<&str, RecordingError> {
        self.names.get(index).map(String::as_str).ok_or_else(|| self.no_frame(index))
    }

    fn no_frame(&self, index: usize) -> RecordingError {
        let path = self.manifest.path.clone();
        RecordingError::NoSuchFrame { path, index, count: self.names.len() }
    }

    fn range(&self, name: &str) -> Result<Range, RecordingError> {
        let path = self.manifest.range.path(name);
        let info = self.camera_text();
        match (self.manifest.kind, self.camera_size(&info)) {
            (RangeKind::Depth, Some(camera)) => {
                let extension = self.manifest.range.extension();
                read_depth(&path, extension, self.manifest.unit, camera).map(Range::Depth)
            }
            (RangeKind::Depth, None) => Err(RecordingError::invalid(
                &self.manifest.path,
                "camera.info",
                "the key is missing",
                "Name the camera_info.yaml of the depth camera",
            )),
            (RangeKind::Cloud(frame), camera) => self.cloud(&path, frame, camera).map(Range::Cloud),
        }
    }

    fn cloud(
        &self,
        path: &Path,
        frame: CloudFrame,
        camera: Option<Expected<'_>>,
    ) -> Result<Cloud, RecordingError> {
        let extension = self.manifest.range.extension();
        let cloud = read_cloud(path, extension, self.manifest.unit, frame)?;
        match (cloud.grid(), camera) {
            (Some((w, h)), Some((width, height, what))) if (w, h) != (width, height) => {
                let problem =
                    format!("the cloud is {w} x {h} points, but {what} is {width} x {height}");
                let remedy = "Name the camera info of the cloud, or remove [camera]";
                Err(RecordingError::invalid(path, "cloud", problem, remedy))
            }
            _ => Ok(cloud),
        }
    }

    fn mask(&self, name: &str, range: &Range) -> Result<Option<Mask>, RecordingError> {
        let Some(pattern) = &self.manifest.mask else { return Ok(None) };
        let path = pattern.path(name);
        let range_path = self.manifest.range.path(name);
        let Some((width, height)) = range.size() else {
            return Err(RecordingError::invalid(
                &path,
                "mask",
                format!(
                    "the cloud {} is a list of points, and no pixel of a mask belongs to one",
                    range_path.display()
                ),
                "Store the cloud with rows and columns (an NPY of rows x columns x 3, a PCD with \
                 HEIGHT), or remove frames.mask",
            ));
        };
        read_mask(&path, (width, height, &range_path.display().to_string())).map(Some)
    }

    /// Path of the camera info, for messages about its size.
    pub(super) fn camera_text(&self) -> String {
        self.manifest.camera_info.as_deref().unwrap_or(Path::new("")).display().to_string()
    }

    pub(super) fn camera_size<'a>(&self, info: &'a str) -> Option<Expected<'a>> {
        self.camera().map(|camera| (camera.width(), camera.height(), info))
    }
}
