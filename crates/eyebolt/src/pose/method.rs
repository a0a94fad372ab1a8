//! How a pose comes about.

use super::rotation_net::PoseNetError;
use crate::end_effector::EndEffectorError;
use std::path::PathBuf;

/// How the pose of an end-effector comes about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PoseMethod {
    /// By rotation prediction and a translation that follows from it.
    Rpt,
    /// By matched points.
    Kpm,
    /// By both, and their half turns, judged by what the frame supports.
    #[default]
    Fused,
}

impl PoseMethod {
    /// All, by their names.
    pub const ALL: [(&'static str, Self); 3] =
        [("fused", Self::Fused), ("rpt", Self::Rpt), ("kpm", Self::Kpm)];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rpt => "rpt",
            Self::Kpm => "kpm",
            Self::Fused => "fused",
        }
    }
}

/// Why there is no pose.
#[derive(Debug, thiserror::Error)]
pub enum PoseError {
    /// The end-effector has no shape, or one that cannot be read.
    #[error(transparent)]
    EndEffector(#[from] EndEffectorError),
    /// Of a network.
    #[error(transparent)]
    Net(#[from] PoseNetError),
    /// A network is missing.
    #[error(
        "the model has no network for {}; make it with eyebolt train {}, or choose another method",
        method.name(),
        match method { PoseMethod::Kpm => "keypoints", _ => "rotation" }
    )]
    NoNetwork {
        /// What it is needed for.
        method: PoseMethod,
    },
    /// A file of the model cannot be read.
    #[error("{}: cannot read it: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// In the folder of a network.
    #[error("{}", folder.display())]
    Model {
        /// The folder.
        folder: PathBuf,
        /// What is wrong there.
        source: PoseNetError,
    },
}
