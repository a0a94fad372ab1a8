//! Networks of a model for poses.

use super::estimator::PoseEstimator;
use super::keypoint_net::KeypointNet;
use super::rotation_net::{PoseNetError, RotationNet};
use super::shape::EndEffectorShape;
use super::{PoseError, PoseMethod};
use crate::model_files::{LoadError, ModelFiles};
use eyebolt_net::models::Model;

impl PoseEstimator {
    /// Of `shape`, by the networks of a model that `eyebolt train` made for it.
    ///
    /// # Errors
    ///
    /// Files that are broken, or of something else; no network that `method` needs.
    pub fn open(
        model: &ModelFiles,
        shape: EndEffectorShape,
        method: PoseMethod,
    ) -> Result<Self, PoseError> {
        let rotation = open(model, "rotation", RotationNet::new)?;
        let keypoints = open(model, "keypoints", KeypointNet::new)?;
        Self::new(shape, rotation, keypoints, method)
    }
}

/// The network of that name, if it is there.
fn open<N>(
    model: &ModelFiles,
    name: &str,
    make: impl Fn(Model) -> Result<N, PoseNetError>,
) -> Result<Option<N>, PoseError> {
    if !model.has(name) {
        return Ok(None);
    }
    let of_it = |source| PoseError::Model { folder: model.place(name), source };
    let network = model.load(name).map_err(|error| match error {
        LoadError::Read { path, source } => PoseError::Read { path, source },
        LoadError::Net(error) => of_it(error.into()),
    })?;
    make(network).map(Some).map_err(of_it)
}
