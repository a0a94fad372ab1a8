//! The networks of a model at work in a calibration.

use crate::label::Learned;
use crate::model_files::ModelFiles;
use crate::pipeline::Request;
use crate::pose::{
    ByEndEffector, EndEffectorShape, GlobalSearch, PoseError, PoseEstimator, PoseMethod,
};
use crate::segment::{SegmentError, Segmenter};

/// The networks of a model: they tell the arm's pixels, whatever else moves, and where its end-effector is, if they know
/// it.
#[derive(Debug)]
pub struct Networks {
    labeller: Learned,
    proposer: Option<ByEndEffector>,
}

/// Why the networks of a model cannot be had.
#[derive(Debug, thiserror::Error)]
pub enum NetworksError {
    /// Those that tell pixels.
    #[error(transparent)]
    Segment(#[from] SegmentError),
    /// Those that tell poses.
    #[error(transparent)]
    Pose(#[from] PoseError),
}

/// Networks know the arm's pixels in each image by itself, so that two configurations do: what more of them would
/// tell is allowed for in the expected error.
const FEWEST: usize = 2;

impl Networks {
    /// Of a model that `eyebolt train` made, for the arm and the seed of `request`.
    ///
    /// # Errors
    ///
    /// Files that are not there, broken, or of another robot; an end-effector without a shape.
    pub fn open(model: &ModelFiles, request: &Request<'_>) -> Result<Self, NetworksError> {
        let segmenter = Segmenter::open(model)?;
        let estimator = match segmenter.tells_end_effector() {
            true => estimator(model, request)?,
            false => None,
        };
        let proposer = estimator.map(|it| ByEndEffector::new(it, GlobalSearch::new(request.seed)));
        Ok(Self { labeller: Learned::new(segmenter), proposer })
    }

    /// `request` with these networks as its labeller and proposer; two configurations do.
    pub fn request<'a>(&'a self, request: &Request<'a>) -> Request<'a> {
        let mut request = request.clone();
        request.limits.configurations = request.limits.configurations.min(FEWEST);
        request.labeller = Some(&self.labeller);
        request.proposer = self.proposer.as_ref().map(|it| it as _);
        request
    }
}

/// `None` of a model that has no networks for poses.
fn estimator(
    model: &ModelFiles,
    request: &Request<'_>,
) -> Result<Option<PoseEstimator>, PoseError> {
    let shape = EndEffectorShape::of(request.arm, &request.cache)?;
    match PoseEstimator::open(model, shape, PoseMethod::Fused) {
        Err(PoseError::NoNetwork { .. }) => Ok(None),
        opened => opened.map(Some),
    }
}
