//! The arm's own shape, from the marker's answer on.

use crate::calibrate::Deviation;
use crate::label::Labelling;
use crate::observations::Observations;
use crate::pipeline::{Failure, Outcome, Request, run};
use crate::pose::{Hypothesis, PoseProposer};
use crate::progress::Progress;
use eyebolt_geometry::{Base, Camera, Transform};
use nalgebra::Point3;
use std::error::Error;

/// Proposes the pose that a marker told, and no other.
#[derive(Clone, Copy, Debug)]
pub struct FromMarker {
    /// The depth optical frame's.
    pub camera_from_base: Transform<Camera, Base>,
}

impl PoseProposer for FromMarker {
    fn propose(
        &self,
        observations: &Observations,
        _: &Labelling,
    ) -> Result<Vec<Hypothesis>, Box<dyn Error + Send + Sync>> {
        let camera_from_base = observations.optical_from_camera.inverse() * self.camera_from_base;
        Ok(vec![Hypothesis { camera_from_base, score: 0.0 }])
    }
}

/// The calibration without a marker that begins at `camera_from_base`, with all else as in `request`.
///
/// # Errors
///
/// As [`run`].
pub fn follow(
    request: &Request<'_>,
    camera_from_base: &Transform<Camera, Base>,
    progress: &dyn Progress,
) -> Result<Outcome, Failure> {
    let from = FromMarker { camera_from_base: *camera_from_base };
    run(&Request { proposer: Some(&from), ..request.clone() }, progress)
}

/// How far the answer without a marker is from the one with it, where the arm was; `None` if there is none.
pub fn difference(
    outcome: &Outcome,
    camera_from_base: &Transform<Camera, Base>,
    at_in_base: &Point3<f64>,
) -> Option<Deviation> {
    let other = outcome.calibration.camera_from_base?;
    Some(Deviation::between(&other, camera_from_base, at_in_base))
}
