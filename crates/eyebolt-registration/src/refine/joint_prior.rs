//! How far off the joints of this arm are likely to be, from what its joints together show:
//! ARCHITECTURE.md, (7).

use super::covariance::sandwich;
use super::priors::with_priors;
use super::system::System;
use crate::arm::MOST_JOINTS;
use crate::unknowns::{FIRST_JOINT, State};
use nalgebra::{SMatrix, SVector};

type Offsets = SVector<f64, MOST_JOINTS>;
type Covariance = SMatrix<f64, MOST_JOINTS, MOST_JOINTS>;

/// Prior deviation under which the joints are asked what they show, radians: more than arms are off.
const OPEN_RAD: f64 = 0.05;
/// Deviations tried for all joints, radians: from what good arms show, 0.006 degrees, to 2 degrees.
const LEAST_RAD: f64 = 1e-4;
const LARGEST_RAD: f64 = 0.035;
/// From one deviation tried to the next.
const RATIO: f64 = 1.25;
/// Variances of offsets are this many times what the scores of a few dozen patches say: on simulated
/// arms without offsets, some seem off by up to five of the deviations that these say.
const OVERCONFIDENCE: f64 = 4.0;
/// What a joint has to add to the logarithm of the likelihood to have a deviation of its own: about
/// three of its deviations.
const STANDS_OUT: f64 = 3.0;

/// Standard deviation of the prior of each joint's offset, radians, that makes what `system` says of
/// the offsets most likely (empirical Bayes: Efron and Morris, Journal of the American Statistical
/// Association 1973): one for all joints, but for those that stand out.
///
/// `gauge`: the joints of whose offsets those of the others tell nothing.
pub(super) fn estimate(
    system: &System<'_>,
    state: &State,
    gauge: [bool; MOST_JOINTS],
) -> [f64; MOST_JOINTS] {
    let Some((mut offsets, covariance)) = under_open_prior(system, state) else {
        return [LEAST_RAD; MOST_JOINTS];
    };
    for joint in (0..MOST_JOINTS).filter(|joint| gauge[*joint]) {
        offsets[joint] = LARGEST_RAD;
    }
    most_likely(&offsets, &covariance, gauge).into()
}

/// What the evidence says of the offsets if they may be anything, and how surely.
pub(super) fn under_open_prior(
    system: &System<'_>,
    state: &State,
) -> Option<(Offsets, Covariance)> {
    let open = [OPEN_RAD; MOST_JOINTS];
    let sum = with_priors(system.total(), state, &open);
    let step = sum.solve(1e-6)?;
    let covariance = sandwich(system, &sum, state, &open, &step)?;
    let joints = step.fixed_rows::<MOST_JOINTS>(FIRST_JOINT).into_owned();
    let block = covariance.fixed_view::<MOST_JOINTS, MOST_JOINTS>(FIRST_JOINT, FIRST_JOINT);
    Some((Offsets::from(state.joint_offsets.rad) + joints, block * OVERCONFIDENCE))
}

/// The deviations that make `offsets`, known up to `covariance`, most likely; those `apart` are off by
/// their own.
fn most_likely(
    offsets: &Offsets,
    covariance: &Covariance,
    mut apart: [bool; MOST_JOINTS],
) -> Offsets {
    let (mut best, mut deviations) = with_apart(offsets, covariance, &apart);
    loop {
        let others = (0..MOST_JOINTS).filter(|joint| !apart[*joint]).map(|joint| {
            let mut more = apart;
            more[joint] = true;
            (with_apart(offsets, covariance, &more), more)
        });
        let found = others.max_by(|((a, _), _), ((b, _), _)| a.total_cmp(b));
        match found {
            Some(((likelihood, found), more)) if likelihood > best + STANDS_OUT => {
                (best, deviations, apart) = (likelihood, found, more);
            }
            _ => return deviations,
        }
    }
}

/// The best deviation for those joints that are not `apart`, each of which is off by its own; and the
/// logarithm of the likelihood.
fn with_apart(
    offsets: &Offsets,
    covariance: &Covariance,
    apart: &[bool; MOST_JOINTS],
) -> (f64, Offsets) {
    let tried = std::iter::successors(Some(LEAST_RAD), |deviation| Some(deviation * RATIO));
    let all = tried.take_while(|deviation| *deviation <= LARGEST_RAD).map(|common| {
        let deviations = Offsets::from_fn(|joint, _| match apart[joint] {
            true => offsets[joint].abs().max(LEAST_RAD),
            false => common,
        });
        (log_likelihood(offsets, covariance, &deviations), deviations)
    });
    let worst = (f64::NEG_INFINITY, Offsets::repeat(LEAST_RAD));
    all.fold(worst, |best, next| if next.0 > best.0 { next } else { best })
}

fn log_likelihood(offsets: &Offsets, covariance: &Covariance, deviations: &Offsets) -> f64 {
    let total = covariance + Covariance::from_diagonal(&deviations.map(|d| d * d));
    let Some(factor) = total.cholesky() else { return f64::NEG_INFINITY };
    let log_determinant: f64 = factor.l_dirty().diagonal().iter().map(|d| d.ln()).sum();
    -log_determinant - 0.5 * offsets.dot(&factor.solve(offsets))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIGMA_DEG: f64 = 0.02;

    /// Of joints that are known to 0.02 degrees.
    fn prior_deg(offsets_deg: [f64; MOST_JOINTS]) -> [f64; MOST_JOINTS] {
        let variance = SIGMA_DEG.to_radians().powi(2);
        let offsets = Offsets::from(offsets_deg).map(f64::to_radians);
        let apart = [false; MOST_JOINTS];
        let prior = most_likely(&offsets, &(Covariance::identity() * variance), apart);
        prior.map(f64::to_degrees).into()
    }

    #[test]
    fn what_the_errors_explain_is_no_offset() {
        let noise = prior_deg([0.02, -0.015, 0.01, -0.02, 0.022, 0.0, -0.018, 0.012]);
        assert!(noise.iter().all(|prior| *prior < 0.006), "{noise:?}");
    }

    #[test]
    fn joints_that_are_all_off_have_a_prior_as_wide() {
        let off = prior_deg([0.3, -0.25, 0.35, -0.3, -0.4, 0.3, 0.2, -0.3]);
        assert!(off.iter().all(|prior| (0.25..0.4).contains(prior)), "{off:?}");
    }

    #[test]
    fn one_joint_that_is_off_does_not_put_the_others_in_doubt() {
        let one = prior_deg([0.01, -0.015, 0.01, -0.3, 0.01, 0.0, -0.01, 0.01]);
        for (joint, prior) in one.iter().enumerate() {
            let expected = if joint == 3 { 0.25..0.35 } else { 0.0..0.006 };
            assert!(expected.contains(prior), "{one:?}");
        }
    }
}
