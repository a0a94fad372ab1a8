//! Why nothing is segmented.

use crate::model_files::ModelFiles;
use std::path::{Path, PathBuf};

/// Why nothing is segmented.
#[derive(Debug, thiserror::Error)]
pub enum SegmentError {
    /// Of the network: broken files, too large an image.
    #[error(transparent)]
    Net(#[from] eyebolt_net::Error),
    /// The network is for something else.
    #[error(
        "model.toml: {field}: {problem}. Name the folder of a segmentation that eyebolt train made"
    )]
    OtherModel {
        /// The field.
        field: &'static str,
        /// What is wrong with it.
        problem: String,
    },
    /// A file of the model cannot be read.
    #[error(
        "{}: cannot read it. Name the folder of a model, or one that comes with eyebolt ({}), or make one with eyebolt train",
        path.display(),
        ModelFiles::names().join(", ")
    )]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// In the folder of a model.
    #[error("{}", folder.display())]
    Model {
        /// The folder.
        folder: PathBuf,
        /// What is wrong there.
        source: Box<SegmentError>,
    },
    /// The networks do not tell the end-effector.
    #[error(
        "{}: the model tells the arm, but not its end-effector. Teach one for this robot with eyebolt train",
        folder.display()
    )]
    NoEndEffector {
        /// The folder of the model.
        folder: PathBuf,
    },
    /// Image and camera are of different sizes.
    #[error("the depth image has {found:?} pixels, its camera {camera:?}")]
    Size {
        /// Width and height of the image.
        found: (u32, u32),
        /// Those of the camera.
        camera: (u32, u32),
    },
}

impl SegmentError {
    /// This error, as one of the network in `folder`.
    pub(super) fn of(self, folder: &Path) -> Self {
        Self::Model { folder: folder.to_owned(), source: Box::new(self) }
    }
}
