//! `recording.toml`: which files of a folder are what, and in which unit.

mod fields;
mod keys;
mod raw;
mod source;

pub(crate) use fields::{Background, JointFiles, RangeKind};
pub use fields::{CloudFrame, RobotSection};

use crate::depth_unit::DepthUnit;
use crate::error::RecordingError;
use crate::file::read_text;
use crate::pattern::Pattern;
use raw::Raw;
use source::Source;
use std::path::{Path, PathBuf};

/// A `recording.toml` that makes sense; paths are joined to its folder.
#[derive(Clone, Debug)]
pub(crate) struct Manifest {
    pub(crate) path: PathBuf,
    pub(crate) camera_info: Option<PathBuf>,
    pub(crate) tf_static: Option<PathBuf>,
    pub(crate) kind: RangeKind,
    pub(crate) range: Pattern,
    pub(crate) unit: DepthUnit,
    pub(crate) color: Option<Pattern>,
    pub(crate) mask: Option<Pattern>,
    pub(crate) joints: JointFiles,
    /// In the order of the numbers of an NPY file, which has no names of its own.
    pub(crate) joint_names: Option<Vec<String>>,
    pub(crate) background: Option<Background>,
    pub(crate) robot: RobotSection,
}

const CAMERA: &str = "name the camera_info.yaml of the depth camera";
const BACKGROUND_CAMERA: &str =
    "name the camera_info.yaml of the background, which is a depth image";

impl Manifest {
    /// Reads the `recording.toml` at `path`.
    pub(crate) fn read(path: &Path) -> Result<Self, RecordingError> {
        Self::parse(path, &read_text(path, "the recording's description")?)
    }

    /// As [`Manifest::read`], from text.
    pub(crate) fn parse(path: &Path, text: &str) -> Result<Self, RecordingError> {
        let raw: Raw = keys::parse(path, text)?;
        // The parent of a bare file name is "", which no system opens as a folder.
        let root = match path.parent() {
            Some(parent) if parent != Path::new("") => parent,
            _ => Path::new("."),
        };
        let source = Source { path, root };
        let frames = &raw.frames;
        let (kind, range) = source.range(frames)?;
        let info = raw.camera.info.map(|info| root.join(info));
        if kind == RangeKind::Depth && info.is_none() {
            return Err(source.missing("camera.info", CAMERA));
        }
        let joints = source.joints(frames)?;
        let unit = source.unit("frames.depth_unit", frames.depth_unit.as_ref())?;
        let background = raw.background.as_ref().map(|raw| source.background(raw, unit));
        let background = background.transpose()?;
        if background.is_some() && info.is_none() {
            return Err(source.missing("camera.info", BACKGROUND_CAMERA));
        }
        Ok(Self {
            path: path.to_path_buf(),
            camera_info: info,
            tf_static: raw.camera.tf_static.map(|file| root.join(file)),
            kind,
            range,
            unit,
            color: source.pattern("color", frames.color.as_deref(), &["png"])?,
            mask: source.pattern("mask", frames.mask.as_deref(), &["png"])?,
            joint_names: source.joint_names(frames, &joints)?,
            joints,
            background,
            robot: RobotSection {
                urdf: raw.robot.urdf.map(|urdf| root.join(urdf)),
                description: None,
                base: raw.robot.base,
                end_effector: raw.robot.end_effector,
            },
        })
    }

    /// Name of the field with the pattern of depths or clouds.
    pub(crate) fn range_field(&self) -> &'static str {
        if self.kind == RangeKind::Depth { "frames.depth" } else { "frames.cloud" }
    }
}
