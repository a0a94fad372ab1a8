//! Means of rotations and of rigid transforms.
//!
//! [`mean_rotation`] is the quaternion mean of Markley, Cheng, Crassidis and Oshman, "Averaging
//! quaternions", Journal of Guidance, Control, and Dynamics 30(4), 2007, which minimises the
//! weighted squared chordal distance and knows no sign; [`intrinsic_mean_rotation`] minimises the
//! weighted squared angle.

use crate::frame::CoordinateFrame;
use crate::tangent::{rotation_exp, rotation_log};
use crate::transform::Transform;
use nalgebra::{Matrix4, Quaternion, SymmetricEigen, UnitQuaternion, Vector3};

/// Why there is no mean.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeanError {
    /// Nothing to average.
    #[error("the mean of nothing is not defined")]
    Empty,
    /// As many weights as values are needed.
    #[error("{values} values but {weights} weights")]
    WeightCount {
        /// How many values were given.
        values: usize,
        /// How many weights were given.
        weights: usize,
    },
    /// A weight is negative or not finite, or all are zero.
    #[error("weights must be finite, not negative and not all zero")]
    Weights,
    /// A value is not finite.
    #[error("value {index} is not finite")]
    NotFinite {
        /// Index of the value.
        index: usize,
    },
    /// The rotations point apart so evenly that no one is in their middle.
    #[error("the rotations have no unique mean: they are spread too evenly")]
    Ambiguous,
    /// The iteration did not settle: the rotations are spread over half a turn or more.
    #[error("the intrinsic mean did not converge: the rotations are spread too widely")]
    NotConverged,
}

/// Share of the total weight by which the largest eigenvalue must lead, else the mean is ambiguous.
const MIN_EIGENVALUE_LEAD: f64 = 1e-9;

/// Markley's mean of rotations, with `w >= 0`; equal weights if `weights` is `None`.
///
/// # Errors
///
/// Nothing given, weights that do not fit or cannot weigh, values that are not finite, or no
/// unique mean (the two largest eigenvalues are equal).
pub fn mean_rotation(
    rotations: &[UnitQuaternion<f64>],
    weights: Option<&[f64]>,
) -> Result<UnitQuaternion<f64>, MeanError> {
    let weights = normalised_weights(rotations.len(), weights)?;
    for (index, rotation) in rotations.iter().enumerate() {
        if !rotation.coords.iter().all(|v| v.is_finite()) {
            return Err(MeanError::NotFinite { index });
        }
    }
    let mut moment = Matrix4::zeros();
    for (rotation, weight) in rotations.iter().zip(&weights) {
        moment += rotation.coords * rotation.coords.transpose() * *weight;
    }
    largest_eigenvector(moment)
}

/// The unit quaternion along the largest eigenvector of `moment`, whose trace is 1.
fn largest_eigenvector(moment: Matrix4<f64>) -> Result<UnitQuaternion<f64>, MeanError> {
    let eigen = SymmetricEigen::try_new(moment, f64::EPSILON, 1000).ok_or(MeanError::Ambiguous)?;
    let largest = eigen.eigenvalues.imax();
    let value = eigen.eigenvalues[largest];
    let second = (0..4)
        .filter(|i| *i != largest)
        .map(|i| eigen.eigenvalues[i])
        .fold(f64::NEG_INFINITY, f64::max);
    if value - second <= MIN_EIGENVALUE_LEAD {
        return Err(MeanError::Ambiguous);
    }
    let coords = eigen.eigenvectors.column(largest).into_owned();
    let sign = if coords.w < 0.0 { -1.0 } else { 1.0 };
    Ok(UnitQuaternion::new_normalize(Quaternion::from(coords * sign)))
}

/// The rotation from which the weighted mean of the rotation vectors to all others is zero.
///
/// Unique where all rotations lie less than pi / 2 from one of them; beyond that, the local
/// answer nearest to [`mean_rotation`], from which the iteration starts.
///
/// # Errors
///
/// As [`mean_rotation`], and when the iteration does not settle in 200 steps.
pub fn intrinsic_mean_rotation(
    rotations: &[UnitQuaternion<f64>],
    weights: Option<&[f64]>,
) -> Result<UnitQuaternion<f64>, MeanError> {
    let mut mean = mean_rotation(rotations, weights)?;
    let weights = normalised_weights(rotations.len(), weights)?;
    for _ in 0..200 {
        let mut step = Vector3::zeros();
        for (rotation, weight) in rotations.iter().zip(&weights) {
            step += rotation_log(&(rotation * mean.inverse())) * *weight;
        }
        mean = rotation_exp(&step) * mean;
        mean.renormalize();
        if step.norm() < 1e-13 {
            return Ok(mean);
        }
    }
    Err(MeanError::NotConverged)
}

/// Arithmetic mean of the translations with Markley's mean of the rotations.
///
/// # Errors
///
/// As [`mean_rotation`].
pub fn mean_transform<To: CoordinateFrame, From: CoordinateFrame>(
    transforms: &[Transform<To, From>],
    weights: Option<&[f64]>,
) -> Result<Transform<To, From>, MeanError> {
    let rotations: Vec<_> = transforms.iter().map(Transform::rotation).collect();
    let rotation = mean_rotation(&rotations, weights)?;
    let weights = normalised_weights(transforms.len(), weights)?;
    let mut translation_m = Vector3::zeros();
    for (index, (transform, weight)) in transforms.iter().zip(&weights).enumerate() {
        let value = transform.translation_m();
        if !value.iter().all(|v| v.is_finite()) {
            return Err(MeanError::NotFinite { index });
        }
        translation_m += value * *weight;
    }
    Ok(Transform::from_parts(translation_m, rotation))
}

/// `weights`, or equal ones, scaled to the sum 1.
fn normalised_weights(values: usize, weights: Option<&[f64]>) -> Result<Vec<f64>, MeanError> {
    if values == 0 {
        return Err(MeanError::Empty);
    }
    let Some(weights) = weights else {
        return Ok(vec![1.0 / values as f64; values]);
    };
    if weights.len() != values {
        return Err(MeanError::WeightCount { values, weights: weights.len() });
    }
    let largest = weights.iter().copied().fold(0.0, f64::max);
    if largest <= 0.0 || weights.iter().any(|w| !w.is_finite() || *w < 0.0) {
        return Err(MeanError::Weights);
    }
    // Dividing by the largest first keeps the sum of huge weights finite.
    let sum: f64 = weights.iter().map(|w| w / largest).sum();
    Ok(weights.iter().map(|w| w / largest / sum).collect())
}
