//! What the fields of a `recording.toml` can say.

use crate::depth_unit::DepthUnit;
use crate::pattern::Pattern;
use std::path::PathBuf;

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
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Background {
    pub(crate) files: Pattern,
    pub(crate) unit: DepthUnit,
}
