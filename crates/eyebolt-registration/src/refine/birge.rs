//! By how much more single kinds of evidence disagree than their noise allows.

use crate::unknowns::POSE;
use nalgebra::{Matrix6, Vector6};

/// By how much the variances of the noise model have to be enlarged for what single `kinds` of evidence say of the pose to agree
/// with it (R. T. Birge, Physical Review 1932): of each its information, and where it has the pose, from one that is near all of
/// them. `None` where they determine no pose together, or where there is one alone.
///
/// The directions in which a kind says nothing count nothing: there it may be anywhere.
pub fn birge_ratio(kinds: &[(Matrix6<f64>, Vector6<f64>)]) -> Option<f64> {
    let all: Matrix6<f64> = kinds.iter().map(|(information, _)| information).sum();
    let sum: Vector6<f64> = kinds.iter().map(|(information, pose)| information * pose).sum();
    let mean = all.cholesky()?.solve(&sum);
    let chi_square: f64 = kinds
        .iter()
        .map(|(information, pose)| (pose - mean).dot(&(information * (pose - mean))))
        .sum();
    let freedom = POSE * kinds.len().checked_sub(1).filter(|others| *others > 0)?;
    Some(chi_square / freedom as f64)
}
