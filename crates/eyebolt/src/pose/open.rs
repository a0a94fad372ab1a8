//! Networks in the folder of a model.

use super::estimator::PoseEstimator;
use super::keypoint_net::KeypointNet;
use super::rotation_net::{PoseNetError, RotationNet};
use super::shape::EndEffectorShape;
use super::{PoseError, PoseMethod};
use eyebolt_net::models::Model;
use std::path::Path;

impl PoseEstimator {
    /// Of `shape`, by the networks in the folder of a model that `eyebolt train` made for it.
    ///
    /// # Errors
    ///
    /// Files that are broken, or of something else; no network that `method` needs.
    pub fn open(
        folder: &Path,
        shape: EndEffectorShape,
        method: PoseMethod,
    ) -> Result<Self, PoseError> {
        let rotation = open(folder, "rotation", RotationNet::new)?;
        let keypoints = open(folder, "keypoints", KeypointNet::new)?;
        Self::new(shape, rotation, keypoints, method)
    }
}

/// The network in the folder of that name, if it is there.
fn open<N>(
    folder: &Path,
    name: &str,
    make: impl Fn(Model) -> Result<N, PoseNetError>,
) -> Result<Option<N>, PoseError> {
    let folder = folder.join(name);
    if !folder.join("model.toml").exists() {
        return Ok(None);
    }
    let file = |name: &str| {
        let path = folder.join(name);
        std::fs::read(&path).map_err(|source| PoseError::Read { path, source })
    };
    let text = String::from_utf8_lossy(&file("model.toml")?).into_owned();
    let weights = file("weights.safetensors")?;
    let model = Model::load(&text, &weights).map_err(PoseNetError::from).and_then(make);
    let failed = |source| PoseError::Model { folder: folder.clone(), source };
    model.map(Some).map_err(failed)
}
