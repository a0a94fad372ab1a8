//! The door for whatever proposes poses.

use crate::label::Labelling;
use crate::observations::Observations;
use eyebolt_geometry::{Base, Camera, Transform};
use std::error::Error;
use std::fmt::Debug;

/// A pose that may be the answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hypothesis {
    /// The pose, in the observations' own camera frame.
    pub camera_from_base: Transform<Camera, Base>,
    /// How badly it explains what was seen, in whatever unit its proposer has: one with twice the
    /// score of the best is not looked at. At least zero.
    pub score: f64,
}

/// Proposes poses: a global search, a network.
pub trait PoseProposer: Debug + Sync {
    /// Hypotheses, best first; `labelling` says which pixels of each configuration are the arm.
    ///
    /// # Errors
    ///
    /// Whatever keeps the proposer from its work; that nothing was found is none.
    fn propose(
        &self,
        observations: &Observations,
        labelling: &Labelling,
    ) -> Result<Vec<Hypothesis>, Box<dyn Error + Send + Sync>>;
}
