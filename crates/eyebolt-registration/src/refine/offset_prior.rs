//! How far off the joints of this arm and the intrinsics of this camera are likely to be, from what all
//! of them together show: ARCHITECTURE.md, (7).

use super::covariance::sandwich;
use super::priors::with_priors;
use super::start::OffsetDeviations;
use super::system::System;
use crate::arm::MOST_JOINTS;
use crate::unknowns::{FIRST_JOINT, OFFSETS, POSE, State};
use nalgebra::{SMatrix, SVector, Vector6};

type Offsets = SVector<f64, OFFSETS>;
type Covariance = SMatrix<f64, OFFSETS, OFFSETS>;

/// What good cameras are off by, and what they are asked under: relative error of the focal lengths,
/// then the principal point in focal lengths. A fifth of a pixel of six hundred is about what a factory's
/// calibration leaves; ten pixels are more than drivers that make intrinsics up are off by.
const LEAST_INTRINSIC: f64 = 3e-4;
const OPEN_INTRINSIC: f64 = 0.03;
/// Likewise links, metres: descriptions have tenths of a millimetre, those made by hand centimetres.
const LEAST_LENGTH_M: f64 = 1e-4;
const OPEN_LENGTH_M: f64 = 0.02;
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
/// Likewise an intrinsic or the length of a link, which move the answer by centimetres, and are hardly
/// ever off: masks that are a little too wide in every view look like one of a few deviations.
const DESCRIBED_STANDS_OUT: f64 = 25.0;
/// What a deviation of all joints has to add.
const ALL_STAND_OUT: f64 = 6.0;

/// Standard deviations of the priors of the offsets that make what `system` says of them most likely
/// (empirical Bayes: Efron and Morris, Journal of the American Statistical Association 1973): one for all
/// joints and a small one for the intrinsics, but for those that stand out.
///
/// `gauge`: the joints of whose offsets those of the others tell nothing.
pub(super) fn estimate(
    system: &System<'_>,
    state: &State,
    gauge: [bool; MOST_JOINTS],
) -> OffsetDeviations {
    let mut apart = [false; OFFSETS];
    apart[..MOST_JOINTS].copy_from_slice(&gauge);
    let Some(UnderOpenPrior { mut offsets, covariance }) = under_open_prior(system, state) else {
        return OffsetDeviations::from_fn(least);
    };
    for joint in (0..MOST_JOINTS).filter(|joint| gauge[*joint]) {
        offsets[joint] = LARGEST_RAD;
    }
    let found = most_likely(&offsets, &covariance, apart);
    tracing::trace!(
        offsets = ?offsets.as_slice(),
        deviations = ?covariance.diagonal().map(f64::sqrt).as_slice(),
        prior = ?found.as_slice(),
        "offsets under an open prior"
    );
    OffsetDeviations::from_fn(|offset| found[offset])
}

/// What an offset is of.
enum Kind {
    Joint,
    Length,
    Intrinsic,
}

fn kind(offset: usize) -> Kind {
    match offset {
        offset if offset < MOST_JOINTS => Kind::Joint,
        offset if offset < 2 * MOST_JOINTS => Kind::Length,
        _ => Kind::Intrinsic,
    }
}

fn stands_out(offset: usize) -> f64 {
    match kind(offset) {
        Kind::Joint => STANDS_OUT,
        Kind::Length | Kind::Intrinsic => DESCRIBED_STANDS_OUT,
    }
}

/// The least deviation of an offset's prior.
fn least(offset: usize) -> f64 {
    match kind(offset) {
        Kind::Joint => LEAST_RAD,
        Kind::Length => LEAST_LENGTH_M,
        Kind::Intrinsic => LEAST_INTRINSIC,
    }
}

/// The deviation under which it is asked what the evidence says of an offset.
fn open(offset: usize) -> f64 {
    match kind(offset) {
        Kind::Joint => OPEN_RAD,
        Kind::Length => OPEN_LENGTH_M,
        Kind::Intrinsic => OPEN_INTRINSIC,
    }
}

/// Something that description or recording may have wrong, and that was taken at its word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Doubt {
    /// By how much the logarithm of the likelihood would grow if it were off by as much as it seems to be.
    pub log_evidence: f64,
    /// Where the pose would go: translation (m) and rotation (rad).
    pub shift: Vector6<f64>,
}

/// The doubts that remain of lengths and intrinsics at `state`, which came with `deviations`, by what is
/// said of the offsets under an `open` prior.
pub(super) fn doubts(
    open: &UnderOpenPrior,
    system: &System<'_>,
    state: &State,
    deviations: &OffsetDeviations,
) -> Vec<Doubt> {
    let UnderOpenPrior { offsets, covariance } = open;
    let given = Offsets::from(deviations.numbers());
    let likelihood = log_likelihood(offsets, covariance, &given);
    let doubtful = (MOST_JOINTS..OFFSETS).filter(|offset| given[*offset] <= least(*offset));
    let doubt = |offset: usize| {
        let mut wide = given;
        wide[offset] = offsets[offset].abs().max(least(offset));
        let log_evidence = log_likelihood(offsets, covariance, &wide) - likelihood;
        let wide = OffsetDeviations::from_fn(|offset| wide[offset]);
        let step = with_priors(system.total(), state, &wide).solve(1e-6)?;
        Some(Doubt { log_evidence, shift: step.fixed_rows::<POSE>(0).into_owned() })
    };
    doubtful.filter_map(doubt).collect()
}

/// What the evidence says of the offsets if they may be anything, and how surely.
pub(super) struct UnderOpenPrior {
    pub offsets: Offsets,
    pub covariance: Covariance,
}

/// Asks the evidence of `system` at `state`; `None` where it does not determine every unknown.
pub(super) fn under_open_prior(system: &System<'_>, state: &State) -> Option<UnderOpenPrior> {
    let open = OffsetDeviations::from_fn(open);
    let sum = with_priors(system.total(), state, &open);
    let step = sum.solve(1e-6)?;
    let covariance = sandwich(system, &sum, state, &open, &step)?;
    let steps = step.fixed_rows::<OFFSETS>(FIRST_JOINT).into_owned();
    let block = covariance.fixed_view::<OFFSETS, OFFSETS>(FIRST_JOINT, FIRST_JOINT);
    let offsets = Offsets::from(state.offsets()) + steps;
    Some(UnderOpenPrior { offsets, covariance: block * OVERCONFIDENCE })
}

/// The deviations that make `offsets`, known up to `covariance`, most likely; those `apart` are off by
/// their own. As few are off as explain what is seen: a deviation of all joints has to be worth several
/// of single ones.
fn most_likely(offsets: &Offsets, covariance: &Covariance, apart: [bool; OFFSETS]) -> Offsets {
    let single = with_more_apart(offsets, covariance, apart, LEAST_RAD);
    let common = with_more_apart(offsets, covariance, apart, LARGEST_RAD);
    if common.0 > single.0 + ALL_STAND_OUT { common.1 } else { single.1 }
}

/// The best deviation up to `largest_rad` of all joints but those `apart`, with further offsets apart as
/// long as each is worth it; the logarithm of the likelihood less what those cost, and all deviations.
fn with_more_apart(
    offsets: &Offsets,
    covariance: &Covariance,
    mut apart: [bool; OFFSETS],
    largest_rad: f64,
) -> (f64, Offsets) {
    let mut cost = 0.0;
    loop {
        let (best, common) = best_common(offsets, covariance, &apart, largest_rad);
        let others = (0..OFFSETS).filter(|offset| !apart[*offset]).map(|offset| {
            let mut more = apart;
            more[offset] = true;
            let likelihood =
                log_likelihood(offsets, covariance, &deviations(offsets, &more, common));
            (likelihood - best - stands_out(offset), offset)
        });
        match others.max_by(|(a, _), (b, _)| a.total_cmp(b)) {
            Some((gain, offset)) if gain > 0.0 => {
                apart[offset] = true;
                cost += stands_out(offset);
            }
            _ => return (best - cost, deviations(offsets, &apart, common)),
        }
    }
}

/// The deviation up to `largest_rad` of those joints that are not `apart` that is most likely, after the
/// logarithm of the likelihood.
fn best_common(
    offsets: &Offsets,
    covariance: &Covariance,
    apart: &[bool; OFFSETS],
    largest_rad: f64,
) -> (f64, f64) {
    let tried = std::iter::successors(Some(LEAST_RAD), |deviation| Some(deviation * RATIO));
    let all = tried.take_while(|deviation| *deviation <= largest_rad).map(|common| {
        (log_likelihood(offsets, covariance, &deviations(offsets, apart, common)), common)
    });
    all.fold((f64::NEG_INFINITY, LEAST_RAD), |best, next| if next.0 > best.0 { next } else { best })
}

/// Offsets `apart` are off by their own, other joints by `common`, and nothing else is off.
fn deviations(offsets: &Offsets, apart: &[bool; OFFSETS], common: f64) -> Offsets {
    Offsets::from_fn(|offset, _| match kind(offset) {
        _ if apart[offset] => offsets[offset].abs().max(least(offset)),
        Kind::Joint => common,
        Kind::Length | Kind::Intrinsic => least(offset),
    })
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
    use crate::intrinsics_offset::INTRINSICS;

    const SIGMA_DEG: f64 = 0.02;

    /// Of joints that are known to 0.02 degrees.
    fn prior_deg(offsets_deg: [f64; MOST_JOINTS]) -> [f64; MOST_JOINTS] {
        let variance = SIGMA_DEG.to_radians().powi(2);
        let mut offsets = Offsets::zeros();
        let joints = SVector::from(offsets_deg).map(f64::to_radians);
        offsets.fixed_rows_mut::<MOST_JOINTS>(0).copy_from(&joints);
        let prior = most_likely(&offsets, &(Covariance::identity() * variance), [false; OFFSETS]);
        std::array::from_fn(|joint| prior[joint].to_degrees())
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

    /// Deviations of the intrinsics' priors, by these offsets in deviations of what is known of them.
    fn intrinsics_prior(sigmas: [f64; INTRINSICS], joint_sigmas: f64) -> [f64; INTRINSICS] {
        let mut offsets = Offsets::zeros();
        offsets[2] = joint_sigmas * SIGMA_DEG.to_radians();
        for (intrinsic, sigmas) in sigmas.into_iter().enumerate() {
            offsets[2 * MOST_JOINTS + intrinsic] = sigmas * INTRINSIC_SIGMA;
        }
        let variance = Offsets::from_fn(|offset, _| match offset < MOST_JOINTS {
            true => SIGMA_DEG.to_radians().powi(2),
            false => INTRINSIC_SIGMA * INTRINSIC_SIGMA,
        });
        let prior = most_likely(&offsets, &Covariance::from_diagonal(&variance), [false; OFFSETS]);
        std::array::from_fn(|intrinsic| prior[2 * MOST_JOINTS + intrinsic])
    }

    /// A thousandth of the focal length, half a pixel of six hundred.
    const INTRINSIC_SIGMA: f64 = 1e-3;

    #[test]
    fn a_focal_length_that_is_clearly_off_stands_out() {
        for sigmas in [-15.0, 15.0] {
            let prior = intrinsics_prior([sigmas, 0.5, -0.5], 0.0);
            assert!((0.010..0.020).contains(&prior[0]), "{prior:?}");
            assert_eq!(prior[1..], [LEAST_INTRINSIC; 2]);
        }
        let prior = intrinsics_prior([0.3, -12.0, 14.0], 0.0);
        assert_eq!(prior[0], LEAST_INTRINSIC);
        assert!(prior[1..].iter().all(|deviation| *deviation > 0.010), "{prior:?}");
    }

    /// A joint would stand out at as many deviations.
    #[test]
    fn one_that_is_weakly_off_does_not() {
        for sigmas in [-5.0, 1.0, 5.0] {
            let prior = intrinsics_prior([sigmas, sigmas, -sigmas], 5.0);
            assert_eq!(prior, [LEAST_INTRINSIC; INTRINSICS]);
        }
        let joint = prior_deg([0.0, 0.0, 5.0 * SIGMA_DEG, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert!(joint[2] > 3.0 * SIGMA_DEG, "{joint:?}");
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
