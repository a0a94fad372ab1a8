//! A recording that is a folder of files with a `recording.toml`.

mod background;
mod frame_files;
mod none_fits;
mod picture;

use crate::color::ColorImage;
use crate::depth_unit::DepthUnit;
use crate::error::RecordingError;
use crate::frame::Frame;
use crate::frame_source::FrameSource;
use crate::joints::{Joints, read_joints};
use crate::manifest::{Manifest, RangeKind, RobotSection};
use crate::message::StaticTransform;
use crate::npy::{Dtype, Npy};
use crate::pattern::Pattern;
use crate::provenance::Provenance;
use crate::tf_file;
use eyebolt_geometry::{DepthImage, PinholeCamera};
use eyebolt_robot::JointPositions;
use frame_files::FrameFiles;
use none_fits::none_fits;
use std::path::{Path, PathBuf};

/// Name of the file that describes a folder.
pub(crate) const MANIFEST: &str = "recording.toml";

/// A recording in a folder. Frames are read when asked for, from as many threads as wanted.
#[derive(Clone, Debug)]
pub struct Folder {
    files: FrameFiles,
    names: Vec<String>,
    joints: Joints,
    /// Names of the backgrounds.
    backgrounds: Vec<String>,
    static_transforms: Vec<StaticTransform>,
    provenance: Provenance,
}

impl Folder {
    /// Opens the recording whose folder, or whose `recording.toml`, is at `path`.
    ///
    /// Reads the description, the camera, its static transforms and the table of the joints if there are any,
    /// lists the frames and checks that their files exist; what is in them is read later.
    ///
    /// # Errors
    ///
    /// A description that is not understood, a camera or a table of joints that cannot be read, no
    /// frames, no backgrounds where these are named, or a frame without its joints, mask or colour
    /// picture where these are named.
    pub fn open(path: &Path) -> Result<Self, RecordingError> {
        Self::open_in(path, None)
    }

    /// As [`Folder::open`], of depth in `unit` where that is told, whatever the description says.
    ///
    /// # Errors
    ///
    /// As of [`Folder::open`].
    pub fn open_in(path: &Path, unit: Option<DepthUnit>) -> Result<Self, RecordingError> {
        let path = if path.is_dir() { path.join(MANIFEST) } else { path.to_path_buf() };
        let mut manifest = Manifest::read(&path)?;
        manifest.unit = unit.unwrap_or(manifest.unit);
        let names = manifest.range.frames(manifest.range_field())?;
        let info = picture::camera(&manifest, names.first())?;
        if names.is_empty() {
            return Err(none_fits(&path, manifest.range_field(), &manifest.range));
        }
        let backgrounds = background::names(&manifest, &names)?;
        let joints = Joints::open(&manifest, &names)?;
        check_files(&manifest, &joints, &names)?;
        let tf_static = manifest.tf_static.as_deref();
        let static_transforms = tf_static.map(|file| tf_file::read(file, "camera.tf_static"));
        let static_transforms = static_transforms.transpose()?.unwrap_or_default();
        let provenance = Provenance {
            name: path.display().to_string(),
            kind: "folder",
            files: vec![path],
            ..Provenance::default()
        };
        let files = FrameFiles { manifest, info };
        Ok(Self { files, names, joints, backgrounds, static_transforms, provenance })
    }

    /// The file that describes it.
    pub(crate) fn path(&self) -> &Path {
        &self.files.manifest.path
    }

    /// File of the colour picture of frame `index`, if there are pictures and that frame.
    pub fn color_path(&self, index: usize) -> Option<PathBuf> {
        Some(self.files.manifest.color.as_ref()?.path(self.names.get(index)?))
    }

    fn name(&self, index: usize) -> Result<&str, RecordingError> {
        self.names.get(index).map(String::as_str).ok_or_else(|| self.no_frame(index))
    }

    fn no_frame(&self, index: usize) -> RecordingError {
        let path = self.path().to_path_buf();
        RecordingError::NoSuchFrame { path, index, count: self.names.len() }
    }
}

impl FrameSource for Folder {
    /// The camera, if the description names its intrinsics; a recording of depth always has one.
    fn camera(&self) -> Option<&PinholeCamera> {
        self.files.camera()
    }

    fn camera_frame_id(&self) -> Option<&str> {
        self.files.info.as_ref()?.frame_id.as_deref()
    }

    fn static_transforms(&self) -> &[StaticTransform] {
        &self.static_transforms
    }

    fn robot(&self) -> &RobotSection {
        &self.files.manifest.robot
    }

    /// Names of the frames, numbers in their order.
    fn frame_names(&self) -> &[String] {
        &self.names
    }

    fn has_masks(&self) -> bool {
        self.files.manifest.mask.is_some()
    }

    /// # Errors
    ///
    /// No such frame; a file that cannot be read, is damaged, or does not fit the camera, the
    /// description or the range image; values that cannot be in the unit claimed; a frame that saw
    /// nothing; an empty mask.
    fn read_frame(&self, index: usize) -> Result<Frame, RecordingError> {
        let name = self.name(index)?;
        let range = self.files.range(name)?;
        let mask = self.files.mask(name, &range)?;
        let joints = self.read_joints(index)?;
        Ok(Frame { name: name.to_owned(), range, mask, joints })
    }

    /// # Errors
    ///
    /// No such frame; a file that cannot be read or is damaged; a joint of the description that is
    /// not there, or is there twice; a position that is not finite or cannot be in radians.
    fn read_joints(&self, index: usize) -> Result<JointPositions, RecordingError> {
        let name = self.name(index)?;
        match &self.joints {
            Joints::Table(rows) => rows.get(index).cloned().ok_or_else(|| self.no_frame(index)),
            Joints::PerFrame(pattern) => {
                let names = self.files.manifest.joint_names.as_deref();
                read_joints(&pattern.path(name), pattern.extension(), names)
            }
        }
    }

    /// # Errors
    ///
    /// No such frame; a file that cannot be read, is damaged, or is not of the camera's size.
    fn read_color(&self, index: usize) -> Result<Option<ColorImage>, RecordingError> {
        self.files.color(self.name(index)?)
    }

    fn background_count(&self) -> usize {
        self.backgrounds.len()
    }

    /// # Errors
    ///
    /// No such background; a file that cannot be read, is damaged, is not of the camera's size or
    /// cannot be in the unit claimed.
    fn read_background(&self, index: usize) -> Result<DepthImage, RecordingError> {
        let name = self.backgrounds.get(index);
        let read = name.map_or(Ok(None), |name| self.files.background(name))?;
        read.ok_or_else(|| {
            let (path, count) = (self.path().to_path_buf(), self.background_count());
            RecordingError::NoSuchBackground { path, index, count }
        })
    }

    fn in_millimetres(&self) -> bool {
        self.files.in_millimetres()
    }

    fn integer_unit_m(&self) -> Option<f64> {
        let manifest = &self.files.manifest;
        let first = || self.names.first().map(|name| manifest.range.path(name));
        // What NPY holds, its header says. A file that cannot be read is told of elsewhere.
        let integers = manifest.kind == RangeKind::Depth
            && match manifest.range.extension() {
                "png" => true,
                _ => {
                    first().is_some_and(|file| Npy::read(&file, "depth", &[Dtype::Uint16]).is_ok())
                }
            };
        integers.then(|| manifest.unit.metres())
    }

    fn backgrounds_in_millimetres(&self) -> bool {
        self.files.backgrounds_in_millimetres()
    }

    fn provenance(&self) -> &Provenance {
        &self.provenance
    }
}

/// Every frame must have every file that the description names.
fn check_files(
    manifest: &Manifest,
    joints: &Joints,
    names: &[String],
) -> Result<(), RecordingError> {
    let check = |field: &str, pattern: Option<&Pattern>, remedy: &str| {
        let Some(pattern) = pattern else { return Ok(()) };
        let lacking = names.iter().find(|name| !pattern.path(name).is_file());
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
    check("frames.joints", joints.files(), "Add the file, or move the frame away")?;
    check("frames.mask", manifest.mask.as_ref(), rest)?;
    check("frames.color", manifest.color.as_ref(), rest)
}
