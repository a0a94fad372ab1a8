//! How far off the joints of this arm and the intrinsics of this camera are likely to be, from what all
//! of them together show: ARCHITECTURE.md, (7).

use super::birge::birge_ratio;
use super::covariance::sandwich;
use super::priors::with_priors;
use super::start::OffsetDeviations;
use super::system::System;
use crate::arm::MOST_JOINTS;
use crate::unknowns::{EVIDENCE_KINDS, FIRST_JOINT, OFFSETS, POSE, State, Unknowns};
use nalgebra::{SMatrix, SVector};
use std::ops::Range;

pub(super) type Offsets = SVector<f64, OFFSETS>;
pub(super) type Covariance = SMatrix<f64, OFFSETS, OFFSETS>;

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
/// Likewise the length of a link, which moves the answer by centimetres, and is hardly ever off; and each number of
/// the intrinsics where outlines are of masks. Whoever draws these is off by a pixel or two along whole sides of
/// a view, which is what intrinsics that are off look like: of three real views with masks, the principal point seems up to
/// eleven pixels off, and without masks nothing does.
const DESCRIBED_STANDS_OUT: f64 = 25.0;
/// Likewise the focal lengths, or the principal point, without masks: twice what they have in the worst of a hundred good
/// sessions of the study.
const INTRINSIC_STANDS_OUT: f64 = 7.0;
/// Of a pose, as a part of what is known best of it, in metres and radians.
const LEAST_KNOWN: f64 = 1e-9;
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
    let Some(mut open) = under_open_prior(system, state) else {
        return OffsetDeviations::from_fn(least);
    };
    for joint in (0..MOST_JOINTS).filter(|joint| gauge[*joint]) {
        open.offsets[joint] = LARGEST_RAD;
    }
    let found = most_likely(&open, apart);
    tracing::trace!(
        offsets = ?open.offsets.as_slice(),
        deviations = ?open.covariance.diagonal().map(f64::sqrt).as_slice(),
        prior = ?found.as_slice(),
        "offsets under an open prior"
    );
    OffsetDeviations::from_fn(|offset| found[offset])
}

/// Place of the focal lengths among the offsets.
pub(super) const FOCAL: usize = 2 * MOST_JOINTS;

/// Offsets that are off together or not at all: joints, lengths and focal lengths each, and both numbers of the principal
/// point.
pub(super) fn matters() -> impl Iterator<Item = Range<usize>> {
    (0..=FOCAL).map(|offset| offset..offset + 1).chain(std::iter::once(FOCAL + 1..OFFSETS))
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

fn stands_out(matter: &Range<usize>, masked: bool) -> f64 {
    match kind(matter.start) {
        Kind::Joint => STANDS_OUT,
        Kind::Intrinsic if !masked => INTRINSIC_STANDS_OUT,
        Kind::Length | Kind::Intrinsic => DESCRIBED_STANDS_OUT * matter.len() as f64,
    }
}

/// The least deviation of an offset's prior.
pub(super) fn least(offset: usize) -> f64 {
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

/// What the evidence says of the offsets if they may be anything, and how surely.
pub(super) struct UnderOpenPrior {
    pub offsets: Offsets,
    pub covariance: Covariance,
    /// Whether outlines are those of masks.
    pub masked: bool,
}

impl UnderOpenPrior {
    /// Logarithm of the likelihood of the offsets seen, if they are off by these standard deviations.
    pub fn log_likelihood(&self, deviations: &Offsets) -> f64 {
        let total = self.covariance + Covariance::from_diagonal(&deviations.map(|d| d * d));
        let Some(factor) = total.cholesky() else { return f64::NEG_INFINITY };
        let log_determinant: f64 = factor.l_dirty().diagonal().iter().map(|d| d.ln()).sum();
        -log_determinant - 0.5 * self.offsets.dot(&factor.solve(&self.offsets))
    }
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
    let mut covariance = block * OVERCONFIDENCE;
    let more = disagreement(system, &step).max(1.0).sqrt();
    for described in MOST_JOINTS..OFFSETS {
        covariance.row_mut(described).scale_mut(more);
        covariance.column_mut(described).scale_mut(more);
    }
    Some(UnderOpenPrior { offsets, covariance, masked: system.masked })
}

/// How much the poses of single kinds of evidence still disagree once offsets explain what they can of it, after `step`: the Birge
/// ratio of the noise model; 1 where they determine no pose. What offsets do not explain is
/// an error that the kinds have of their own, such as light that comes late by way of the floor; and what it does to lengths and
/// intrinsics no cluster of residuals shows. Zeros of joints it hardly looks like: doubting these makes bumps of them.
fn disagreement(system: &System<'_>, step: &Unknowns) -> f64 {
    let of_kind = |kind: usize| {
        let sum = system.total_of_kind(kind);
        let gradient = sum.gradient + sum.information * step;
        let information = sum.information.fixed_view::<POSE, POSE>(0, 0).into_owned();
        // Nearly nothing in a direction is nothing: what rounding leaves would be taken for far away.
        let pose = information.pseudo_inverse(LEAST_KNOWN * information.amax()).ok()?;
        Some((information, -pose * gradient.fixed_rows::<POSE>(0)))
    };
    let kinds: Option<Vec<_>> = (0..EVIDENCE_KINDS).map(of_kind).collect();
    kinds.and_then(|kinds| birge_ratio(&kinds)).unwrap_or(1.0)
}

/// The deviations that make what is seen most likely; those `apart` are off by their own. As few are off as
/// explain it: a deviation of all joints has to be worth several of single ones.
fn most_likely(open: &UnderOpenPrior, apart: [bool; OFFSETS]) -> Offsets {
    let single = with_more_apart(open, apart, LEAST_RAD);
    let common = with_more_apart(open, apart, LARGEST_RAD);
    if common.0 > single.0 + ALL_STAND_OUT { common.1 } else { single.1 }
}

/// The best deviation up to `largest_rad` of all joints but those `apart`, with further offsets apart as
/// long as each is worth it; the logarithm of the likelihood less what those cost, and all deviations.
fn with_more_apart(
    open: &UnderOpenPrior,
    mut apart: [bool; OFFSETS],
    largest_rad: f64,
) -> (f64, Offsets) {
    let mut cost = 0.0;
    loop {
        let (best, common) = best_common(open, &apart, largest_rad);
        let others = matters().filter(|matter| !apart[matter.start]).map(|matter| {
            let mut more = apart;
            more[matter.clone()].fill(true);
            let likelihood = open.log_likelihood(&deviations(&open.offsets, &more, common));
            (likelihood - best - stands_out(&matter, open.masked), matter)
        });
        match others.max_by(|(a, _), (b, _)| a.total_cmp(b)) {
            Some((gain, matter)) if gain > 0.0 => {
                cost += stands_out(&matter, open.masked);
                apart[matter].fill(true);
            }
            _ => return (best - cost, deviations(&open.offsets, &apart, common)),
        }
    }
}

/// The deviation up to `largest_rad` of those joints that are not `apart` that is most likely, after the
/// logarithm of the likelihood.
fn best_common(open: &UnderOpenPrior, apart: &[bool; OFFSETS], largest_rad: f64) -> (f64, f64) {
    let tried = std::iter::successors(Some(LEAST_RAD), |deviation| Some(deviation * RATIO));
    let all = tried
        .take_while(|deviation| *deviation <= largest_rad)
        .map(|common| (open.log_likelihood(&deviations(&open.offsets, apart, common)), common));
    all.fold((f64::NEG_INFINITY, LEAST_RAD), |best, next| if next.0 > best.0 { next } else { best })
}

/// Offsets `apart` are off by their own, other joints by `common`, and nothing else is off.
fn deviations(offsets: &Offsets, apart: &[bool; OFFSETS], common: f64) -> Offsets {
    let mut all = Offsets::from_fn(|offset, _| match kind(offset) {
        Kind::Joint => common,
        Kind::Length | Kind::Intrinsic => least(offset),
    });
    for matter in matters().filter(|matter| apart[matter.start]) {
        let of_matter = offsets.rows(matter.start, matter.len());
        let rms = of_matter.norm() / (matter.len() as f64).sqrt();
        matter.for_each(|offset| all[offset] = rms.max(least(offset)));
    }
    all
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
        let covariance = Covariance::identity() * variance;
        let open = UnderOpenPrior { offsets, covariance, masked: false };
        let prior = most_likely(&open, [false; OFFSETS]);
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
    fn intrinsics_prior(
        sigmas: [f64; INTRINSICS],
        joint_sigmas: f64,
        masked: bool,
    ) -> [f64; INTRINSICS] {
        let mut offsets = Offsets::zeros();
        offsets[2] = joint_sigmas * SIGMA_DEG.to_radians();
        for (intrinsic, sigmas) in sigmas.into_iter().enumerate() {
            offsets[FOCAL + intrinsic] = sigmas * INTRINSIC_SIGMA;
        }
        let variance = Offsets::from_fn(|offset, _| match offset < MOST_JOINTS {
            true => SIGMA_DEG.to_radians().powi(2),
            false => INTRINSIC_SIGMA * INTRINSIC_SIGMA,
        });
        let covariance = Covariance::from_diagonal(&variance);
        let open = UnderOpenPrior { offsets, covariance, masked };
        let prior = most_likely(&open, [false; OFFSETS]);
        std::array::from_fn(|intrinsic| prior[FOCAL + intrinsic])
    }

    /// A thousandth of the focal length, half a pixel of six hundred.
    const INTRINSIC_SIGMA: f64 = 1e-3;

    #[test]
    fn a_focal_length_that_is_clearly_off_stands_out() {
        for (sigmas, masked) in [(-15.0, true), (15.0, true), (-8.0, false), (8.0, false)] {
            let prior = intrinsics_prior([sigmas, 0.5, -0.5], 0.0, masked);
            let expected = INTRINSIC_SIGMA * f64::abs(sigmas);
            assert!((0.7 * expected..1.3 * expected).contains(&prior[0]), "{prior:?}");
            assert_eq!(prior[1..], [LEAST_INTRINSIC; 2]);
        }
    }

    /// Neither of its numbers would by itself.
    #[test]
    fn a_principal_point_stands_out_with_both_its_numbers() {
        let both = intrinsics_prior([0.3, -4.0, 3.9], 0.0, false);
        assert_eq!(both[0], LEAST_INTRINSIC);
        assert!(both[1] == both[2] && (0.003..0.005).contains(&both[1]), "{both:?}");
        for one in [[0.3, -4.0, 0.0], [0.3, 0.0, 3.9]] {
            assert_eq!(intrinsics_prior(one, 0.0, false), [LEAST_INTRINSIC; INTRINSICS]);
        }
    }

    /// A joint would not need much more.
    #[test]
    fn one_that_is_weakly_off_does_not() {
        for sigmas in [-3.0, 1.0, 3.0] {
            let prior = intrinsics_prior([sigmas, sigmas, -sigmas], 3.0, false);
            assert_eq!(prior, [LEAST_INTRINSIC; INTRINSICS]);
        }
        let joint = prior_deg([0.0, 0.0, 4.0 * SIGMA_DEG, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert!(joint[2] > 3.0 * SIGMA_DEG, "{joint:?}");
    }

    /// Whoever drew them may have been off alike.
    #[test]
    fn by_masks_it_has_to_be_more() {
        for sigmas in [-5.0, 5.0] {
            let of = |masked| intrinsics_prior([sigmas, sigmas, -sigmas], 5.0, masked);
            assert!(of(false).iter().all(|deviation| *deviation > 0.003), "{:?}", of(false));
            assert_eq!(of(true), [LEAST_INTRINSIC; INTRINSICS]);
        }
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
