//! A recording that is a folder of files with a `recording.toml`.

mod background;
mod read;

use crate::camera_info::CameraInfo;
use crate::error::RecordingError;
use crate::joints::Joints;
use crate::manifest::{Manifest, RangeKind, RobotSection, Unit};
use crate::pattern::Pattern;
use eyebolt_geometry::PinholeCamera;
use std::path::{Path, PathBuf};

/// Name of the file that describes a folder.
pub(crate) const MANIFEST: &str = "recording.toml";

/// A recording in a folder. Frames are read when asked for, from as many threads as wanted.
#[derive(Clone, Debug)]
pub struct Folder {
    manifest: Manifest,
    camera: Option<CameraInfo>,
    names: Vec<String>,
    joints: Joints,
    /// Names of the backgrounds.
    backgrounds: Vec<String>,
}

impl Folder {
    /// Opens the recording whose folder, or whose `recording.toml`, is at `path`.
    ///
    /// Reads the description, the camera and the table of the joints if there is one, lists the
    /// frames and checks that their files exist; what is in them is read later.
    ///
    /// # Errors
    ///
    /// A description that is not understood, a camera or a table of joints that cannot be read, no
    /// frames, no backgrounds where these are named, or a frame without its joints, mask or colour picture where these are named.
    pub fn open(path: &Path) -> Result<Self, RecordingError> {
        let path = if path.is_dir() { path.join(MANIFEST) } else { path.to_path_buf() };
        let manifest = Manifest::read(&path)?;
        let camera = manifest.camera_info.as_deref().map(CameraInfo::read).transpose()?;
        let names = manifest.range.frames(manifest.range_field())?;
        if names.is_empty() {
            return Err(none_fits(&path, manifest.range_field(), &manifest.range));
        }
        let backgrounds = background::names(&manifest, &names)?;
        let joints = Joints::open(&manifest, &names)?;
        let folder = Self { manifest, camera, names, joints, backgrounds };
        folder.check_files()?;
        Ok(folder)
    }

    /// The camera, if the description names its intrinsics; a recording of depth always has one.
    pub fn camera(&self) -> Option<&PinholeCamera> {
        self.camera.as_ref().map(|info| &info.camera)
    }

    /// Name of the camera's optical frame in ROS, where its file says it.
    pub fn camera_frame_id(&self) -> Option<&str> {
        self.camera.as_ref()?.frame_id.as_deref()
    }

    /// What the description says of the robot.
    pub fn robot(&self) -> &RobotSection {
        &self.manifest.robot
    }

    /// Names of the frames, numbers in their order.
    pub fn frame_names(&self) -> &[String] {
        &self.names
    }

    /// Whether frames come with masks of the arm.
    pub fn has_masks(&self) -> bool {
        self.manifest.mask.is_some()
    }

    /// The file that describes it.
    pub(crate) fn path(&self) -> &Path {
        &self.manifest.path
    }

    /// Whether depth is stored in whole millimetres.
    pub(crate) fn in_millimetres(&self) -> bool {
        let depth = self.manifest.kind == RangeKind::Depth;
        depth && self.manifest.unit == Unit::Millimetres && self.manifest.range.extension() == "png"
    }

    /// File of the colour picture of frame `index`, if there are pictures and that frame.
    pub fn color_path(&self, index: usize) -> Option<PathBuf> {
        Some(self.manifest.color.as_ref()?.path(self.names.get(index)?))
    }

    /// Every frame must have every file that the description names.
    fn check_files(&self) -> Result<(), RecordingError> {
        let manifest = &self.manifest;
        let check = |field: &str, pattern: Option<&Pattern>, remedy: &str| {
            let Some(pattern) = pattern else { return Ok(()) };
            let lacking = self.names.iter().find(|name| !pattern.path(name).is_file());
            lacking.map_or(Ok(()), |name| {
                let problem = format!(
                    "frame {name} has {} but the file {} is missing",
                    manifest.range.path(name).display(),
                    pattern.path(name).display()
                );
                Err(RecordingError::invalid(&manifest.path, field, problem, remedy))
            })
        };
        let rest = "Add the file, move the frame away, or remove the key";
        check("frames.joints", self.joints.files(), "Add the file, or move the frame away")?;
        check("frames.mask", manifest.mask.as_ref(), rest)?;
        check("frames.color", manifest.color.as_ref(), rest)
    }
}

fn none_fits(path: &Path, field: &str, files: &Pattern) -> RecordingError {
    let problem =
        format!("no file in {} is called \"{}\"", files.folder().display(), files.file_name());
    RecordingError::invalid(path, field, problem, "Correct the pattern, or copy the files there")
}
