//! What a calibration file says of how far off it may be.

use super::field::REMEDY;
use crate::export::error::ExportError;
use nalgebra::{Matrix6, Point3};
use serde::Deserialize;
use std::collections::BTreeSet;

/// How far off a calibration expects to be.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Uncertainty {
    /// Covariance of `camera_from_base`: translation (m), then rotation (rad), both along the camera's axes, the rotation
    /// about the base's origin.
    pub covariance: Option<Matrix6<f64>>,
    /// Where errors are measured, base frame.
    pub workspace_in_base: Option<Point3<f64>>,
    /// Median distance of the arm's points from the posed arm, over the configurations it was made from, metres.
    pub residual_m: Option<f64>,
    /// How many configurations it was made from.
    pub configurations: usize,
}

#[derive(Deserialize, Default)]
#[serde(default)]
pub(super) struct RawUncertainty {
    covariance: Option<[[f64; 6]; 6]>,
    workspace_in_base_m: Option<[f64; 3]>,
    configurations: Vec<RawFrame>,
}

#[derive(Deserialize, Default)]
#[serde(default)]
struct RawFrame {
    configuration: usize,
    used: bool,
    residual_mm: Option<f64>,
}

/// Rounding leaves matrices this asymmetric, as a part of their largest entry.
const ASYMMETRIC: f64 = 1e-6;

impl RawUncertainty {
    pub(super) fn check(self, file: &str) -> Result<Uncertainty, ExportError> {
        let used: Vec<&RawFrame> = self.configurations.iter().filter(|frame| frame.used).collect();
        let mut residuals: Vec<f64> = used.iter().filter_map(|frame| frame.residual_mm).collect();
        let numbers: BTreeSet<usize> = used.iter().map(|frame| frame.configuration).collect();
        Ok(Uncertainty {
            covariance: self.covariance.map(|rows| covariance(file, rows)).transpose()?,
            workspace_in_base: self.workspace_in_base_m.map(Point3::from),
            residual_m: eyebolt_registration::median(&mut residuals).map(|mm| 1e-3 * mm),
            configurations: numbers.len(),
        })
    }
}

fn covariance(file: &str, rows: [[f64; 6]; 6]) -> Result<Matrix6<f64>, ExportError> {
    let invalid = |problem: &str| ExportError::invalid(file, "covariance", problem, REMEDY);
    let matrix = Matrix6::from_row_slice(rows.as_flattened());
    if (matrix - matrix.transpose()).amax() > ASYMMETRIC * matrix.amax() {
        return Err(invalid("it is not symmetric"));
    }
    let matrix = (matrix + matrix.transpose()) * 0.5;
    if matrix.symmetric_eigenvalues().min() < -ASYMMETRIC * matrix.amax() {
        return Err(invalid("a variance is negative"));
    }
    Ok(matrix)
}
