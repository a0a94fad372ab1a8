//! Networks of a model for a segmentation.

use super::end_effector_net::EndEffectorNet;
use super::error::SegmentError;
use super::segmenter::Segmenter;
use crate::model_files::{LoadError, ModelFiles};
use eyebolt_net::models::Model;

impl Segmenter {
    /// Of a model, with all that it has for a segmentation; or of the folder of one network for whole frames. If it knows
    /// one arm, `any-arm`, which comes with eyebolt, is asked for a second opinion.
    ///
    /// # Errors
    ///
    /// Files that are not there, broken, or of something else.
    pub fn open(model: &ModelFiles) -> Result<Self, SegmentError> {
        let whole = if model.has("") { "" } else { "segmentation" };
        let mut segmenter =
            Self::new(read(model, whole)?).map_err(|error| error.of(&model.place(whole)))?;
        if let Some(any) = ModelFiles::any_arm().filter(|_| segmenter.tells_end_effector()) {
            segmenter = segmenter.with_second_opinion(read(&any, "segmentation")?);
        }
        const NEAR: &str = "end_effector";
        if whole.is_empty() || !model.has(NEAR) {
            return Ok(segmenter);
        }
        let net = EndEffectorNet::new(read(model, NEAR)?)
            .map_err(|error| error.of(&model.place(NEAR)))?;
        Ok(segmenter.with_end_effector(net))
    }

    /// As [`Self::open`], of a model that tells the end-effector.
    ///
    /// # Errors
    ///
    /// As there; a model that does not.
    pub fn open_for_end_effector(model: &ModelFiles) -> Result<Self, SegmentError> {
        let segmenter = Self::open(model)?;
        match segmenter.tells_end_effector() {
            true => Ok(segmenter),
            false => Err(SegmentError::NoEndEffector { folder: model.place("") }),
        }
    }
}

fn read(model: &ModelFiles, network: &str) -> Result<Model, SegmentError> {
    model.load(network).map_err(|error| match error {
        LoadError::Read { path, source } => SegmentError::Read { path, source },
        LoadError::Net(error) => SegmentError::from(error).of(&model.place(network)),
    })
}
