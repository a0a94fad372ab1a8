//! What is known beforehand: the stored calibration, and how far off it may be.

use crate::dataset::start;
use crate::export::{ExportError, SavedCalibration};
use crate::observations::Observations;
use eyebolt_geometry::{Camera, Transform};
use eyebolt_registration::Start;
use nalgebra::{Matrix6, Point3};

/// A stored calibration, as it applies to observations.
#[derive(Clone, Debug)]
pub struct Known {
    /// Where it has the arm in the images of the observations, with all that it found to be off.
    pub start: Start,
    /// Covariance of that pose, along the axes of the observations' camera.
    pub covariance: Matrix6<f64>,
    /// Where drifts are measured, base frame.
    pub workspace_in_base: Point3<f64>,
    /// Median distance of the arm's points from the posed arm when it was made, metres.
    pub residual_m: Option<f64>,
}

/// What a calibration without a covariance is taken to be off by, along each axis, metres and radians.
const UNTOLD: f64 = 0.005;
/// No calibration is better than this along each axis: shapes and joints at rest are not.
const LEAST: f64 = 2e-4;

impl Known {
    /// What `calibration` says of the images of `observations`.
    ///
    /// # Errors
    ///
    /// A calibration that was refused, unless `even_if_refused`, or one without a pose.
    pub fn new(
        calibration: &SavedCalibration,
        observations: &Observations,
        even_if_refused: bool,
    ) -> Result<Self, ExportError> {
        let start = start(calibration, observations, even_if_refused)?;
        let told = calibration.uncertainty();
        let untold = Matrix6::<f64>::identity() * UNTOLD.powi(2);
        let to_own = both(&observations.optical_from_camera.inverse());
        let covariance = to_own * told.covariance.unwrap_or(untold) * to_own.transpose();
        Ok(Self {
            start,
            covariance: covariance + Matrix6::<f64>::identity() * LEAST.powi(2),
            workspace_in_base: told.workspace_in_base.unwrap_or_else(|| observations.workspace()),
            residual_m: told.residual_m,
        })
    }
}

/// Turns shifts, translation and rotation alike.
pub(super) fn both(turn: &Transform<Camera, Camera>) -> Matrix6<f64> {
    let turn = turn.rotation().to_rotation_matrix();
    let mut both = Matrix6::zeros();
    both.fixed_view_mut::<3, 3>(0, 0).copy_from(turn.matrix());
    both.fixed_view_mut::<3, 3>(3, 3).copy_from(turn.matrix());
    both
}
