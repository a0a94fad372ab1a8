//! Frames of a folder, from their files.

use crate::camera_info::CameraInfo;
use crate::cloud::read_cloud;
use crate::color::{ColorImage, read_color};
use crate::depth::{read_any_depth, read_depth};
use crate::depth_unit::DepthUnit;
use crate::error::RecordingError;
use crate::frame::Range;
use crate::manifest::{CloudFrame, Manifest, RangeKind};
use crate::mask::read_mask;
use crate::png_image::Expected;
use eyebolt_geometry::{Cloud, DepthImage, Mask, PinholeCamera};
use std::path::Path;

/// What the files of a folder are, and the camera that all of them are of.
#[derive(Clone, Debug)]
pub(super) struct FrameFiles {
    pub(super) manifest: Manifest,
    pub(super) info: Option<CameraInfo>,
}

impl FrameFiles {
    pub(super) fn camera(&self) -> Option<&PinholeCamera> {
        self.info.as_ref().map(|info| &info.camera)
    }

    /// Whether depth is stored in whole millimetres.
    pub(super) fn in_millimetres(&self) -> bool {
        let depth = self.manifest.kind == RangeKind::Depth;
        depth
            && self.manifest.unit == DepthUnit::MILLIMETRES
            && self.manifest.range.extension() == "png"
    }

    /// Whether backgrounds are stored in whole millimetres.
    pub(super) fn backgrounds_in_millimetres(&self) -> bool {
        self.manifest.background.as_ref().is_some_and(|background| {
            background.unit == DepthUnit::MILLIMETRES && background.files.extension() == "png"
        })
    }

    /// Reads the depth of the scene without the robot; `None` where there are no such files.
    pub(super) fn background(&self, name: &str) -> Result<Option<DepthImage>, RecordingError> {
        let info = self.camera_text();
        let Some(background) = &self.manifest.background else { return Ok(None) };
        let Some(camera) = self.camera_size(&info) else { return Ok(None) };
        let files = &background.files;
        read_any_depth(&files.path(name), files.extension(), background.unit, camera).map(Some)
    }

    /// Reads the colour picture of a frame; `None` if the recording has no pictures.
    pub(super) fn color(&self, name: &str) -> Result<Option<ColorImage>, RecordingError> {
        let Some(pattern) = &self.manifest.color else { return Ok(None) };
        let info = self.camera_text();
        read_color(&pattern.path(name), self.camera_size(&info)).map(Some)
    }

    /// Reads the depth image or cloud of a frame.
    pub(super) fn range(&self, name: &str) -> Result<Range, RecordingError> {
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

    /// Reads the mask of a frame; `None` if the recording has no masks.
    pub(super) fn mask(&self, name: &str, range: &Range) -> Result<Option<Mask>, RecordingError> {
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
    fn camera_text(&self) -> String {
        self.manifest.camera_info.as_deref().unwrap_or(Path::new("")).display().to_string()
    }

    fn camera_size<'a>(&self, info: &'a str) -> Option<Expected<'a>> {
        self.camera().map(|camera| (camera.width(), camera.height(), info))
    }
}
