//! How far off the joints of this arm are likely to be, from what its joints together show.

use super::evidence::Evidence;
use super::summary::sandwich;
use super::weighing::Weighing;
use crate::arm::MOST_JOINTS;
use crate::factors::{FIRST_JOINT, State};
use nalgebra::{SMatrix, SVector};

/// Prior deviation under which the joints are asked what they show, radians: far more than any arm
/// is off.
const OPEN_PRIOR_RAD: f64 = 0.05;
/// How many times the variances of offsets are larger than scores of a few dozen patches say:
/// simulated arms without offsets show some that are three deviations off.
const OVERCONFIDENCE: f64 = 4.0;
/// Least and largest deviation that can come out, radians.
const LEAST_RAD: f64 = 1.75e-4;
const LARGEST_RAD: f64 = 0.035;
/// From one deviation tried to the next.
const RATIO: f64 = 1.2;

/// The deviation of offsets that makes those of `state`, as far as `evidence` determines them, most
/// likely (empirical Bayes: Efron and Morris, Journal of the American Statistical Association 1973).
pub(super) fn estimate(evidence: &[Evidence], weighing: &Weighing, state: &State) -> f64 {
    let open = Weighing { joint_prior_rad: OPEN_PRIOR_RAD, ..*weighing };
    let sum = open.total(evidence, state);
    let Some(step) = sum.solve(1e-6) else { return LEAST_RAD };
    let Some(covariance) = sandwich(evidence, &open, state, &sum, &step) else { return LEAST_RAD };
    let joints = step.fixed_rows::<MOST_JOINTS>(FIRST_JOINT);
    let offsets = SVector::from(state.joint_offsets.rad) + joints;
    let block = covariance.fixed_view::<MOST_JOINTS, MOST_JOINTS>(FIRST_JOINT, FIRST_JOINT);
    most_likely(&offsets, &(block * OVERCONFIDENCE))
}

fn most_likely(
    offsets: &SVector<f64, MOST_JOINTS>,
    covariance: &SMatrix<f64, MOST_JOINTS, MOST_JOINTS>,
) -> f64 {
    let eigen = covariance.symmetric_eigen();
    let along = eigen.eigenvectors.tr_mul(offsets);
    let log_likelihood = |deviation: f64| -> f64 {
        let axes = eigen.eigenvalues.iter().zip(along.iter());
        let each = axes.map(|(variance, offset)| {
            let total = variance.max(0.0) + deviation * deviation;
            -0.5 * (total.ln() + offset * offset / total)
        });
        each.sum()
    };
    let steps = ((LARGEST_RAD / LEAST_RAD).ln() / RATIO.ln()) as i32;
    let tried = (0..=steps).map(|step| LEAST_RAD * RATIO.powi(step));
    let best = tried.map(|deviation| (log_likelihood(deviation), deviation));
    best.max_by(|a, b| a.0.total_cmp(&b.0)).map_or(LEAST_RAD, |(_, deviation)| deviation)
}
