//! `recording.toml`: which files of a folder are what, and in which unit.

mod keys;
mod raw;
mod source;

use crate::error::RecordingError;
use crate::file::read_text;
use crate::pattern::Pattern;
use raw::Raw;
use source::Source;
use std::path::{Path, PathBuf};

/// The robot of a recording; what is absent must come from elsewhere.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RobotSection {
    /// Path of the robot description, relative to the working folder or absolute. May not exist.
    pub urdf: Option<PathBuf>,
    /// The robot description itself (URDF text), where the recording holds it.
    pub description: Option<String>,
    /// Name of the arm's root link.
    pub base: Option<String>,
    /// Name of the end-effector link.
    pub end_effector: Option<String>,
}

/// Unit of stored lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unit {
    Metres,
    Millimetres,
}

impl Unit {
    /// Metres of one.
    pub(crate) fn metres(self) -> f32 {
        match self {
            Self::Metres => 1.0,
            Self::Millimetres => 1e-3,
        }
    }
}

/// Frame that the points of a cloud are stored in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CloudFrame {
    /// x right, y down, z forward.
    Optical,
    /// x forward, y left, z up.
    Body,
}

impl CloudFrame {
    /// Its name in files.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Optical => "optical",
            Self::Body => "body",
        }
    }

    /// The frame of this name.
    pub(crate) fn named(name: &str) -> Option<Self> {
        [Self::Optical, Self::Body].into_iter().find(|frame| frame.name() == name)
    }
}

/// What the range of a frame is stored as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RangeKind {
    Depth,
    Cloud(CloudFrame),
}

/// Where the positions of the joints are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum JointFiles {
    /// A file for every frame.
    PerFrame(Pattern),
    /// One file of all frames, CSV or JSON.
    Table(PathBuf),
}

/// Depth images of the scene without the robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Background {
    pub(crate) files: Pattern,
    pub(crate) unit: Unit,
}

/// A `recording.toml` that makes sense; paths are joined to its folder.
#[derive(Clone, Debug)]
pub(crate) struct Manifest {
    pub(crate) path: PathBuf,
    pub(crate) camera_info: Option<PathBuf>,
    pub(crate) kind: RangeKind,
    pub(crate) range: Pattern,
    pub(crate) unit: Unit,
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
        let unit = source.unit("frames.depth_unit", frames.depth_unit.as_deref())?;
        let background = raw.background.as_ref().map(|raw| source.background(raw, unit));
        let background = background.transpose()?;
        if background.is_some() && info.is_none() {
            return Err(source.missing("camera.info", BACKGROUND_CAMERA));
        }
        Ok(Self {
            path: path.to_path_buf(),
            camera_info: info,
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
