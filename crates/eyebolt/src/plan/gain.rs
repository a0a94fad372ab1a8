//! How far off a calibration is expected to be, by what its views say.

use crate::calibrate::{Deviation, expected_of};
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::{MOST_JOINTS, PREDICTED, PredictedInformation};
use nalgebra::{Matrix6, Point3};

/// What is known before any view, as standard deviations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known {
    /// Of where the camera is, metres and radians, each along or about one axis.
    pub pose: [f64; 2],
    /// Of the depth's scale, and of the width of outlines, pixels.
    pub nuisances: [f64; 2],
    /// Of each joint's zero, radians.
    pub joint_rad: f64,
}

impl Default for Known {
    /// Somebody has seen where the camera stands; all else as calibrations have it, and joint zeros as arms in use have
    /// them.
    fn default() -> Self {
        Self { pose: [0.1, 0.1], nuisances: [0.02, 1.0], joint_rad: 2e-3 }
    }
}

impl Known {
    /// The same as information.
    pub(super) fn information(&self) -> PredictedInformation {
        let mut all = PredictedInformation::zeros();
        let [metres, radians] = self.pose;
        let pose = [metres, metres, metres, radians, radians, radians];
        let joints = [self.joint_rad; MOST_JOINTS];
        let deviations = pose.into_iter().chain(self.nuisances).chain(joints);
        for (unknown, deviation) in deviations.enumerate() {
            all[(unknown, unknown)] = deviation.powi(-2);
        }
        all
    }
}

/// Where errors are measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measured {
    pub(super) camera_from_base: Transform<Camera, Base>,
    pub(super) workspace_in_base: Point3<f64>,
}

/// A radian of error counts as much as so many metres: the reach of a hand about the middle of the workspace.
const METRES_A_RADIAN: f64 = 0.3;

impl Measured {
    /// Covariance of the pose by `information` about all unknowns, the others profiled out; `None` where that is not of full
    /// rank.
    fn covariance(information: &PredictedInformation) -> Option<Matrix6<f64>> {
        let factor = information.cholesky()?;
        // Columns of the inverse that belong to the pose are all that is needed.
        let pose = nalgebra::SMatrix::<f64, PREDICTED, 6>::identity();
        Some(factor.solve(&pose).fixed_view::<6, 6>(0, 0).into_owned())
    }

    /// Root mean square error to expect by `information`.
    pub(super) fn expected(&self, information: &PredictedInformation) -> Deviation {
        let nothing = Matrix6::from_element(f64::INFINITY);
        let covariance = Self::covariance(information).unwrap_or(nothing);
        expected_of(&covariance, &self.camera_from_base, &self.workspace_in_base)
    }

    /// One number for an expected error, square metres: what is made small (A-optimal).
    pub(super) fn cost(&self, information: &PredictedInformation) -> f64 {
        let Deviation { translation_m, rotation_rad } = self.expected(information);
        let cost = translation_m.powi(2) + (METRES_A_RADIAN * rotation_rad).powi(2);
        if cost.is_finite() { cost } else { f64::INFINITY }
    }
}
