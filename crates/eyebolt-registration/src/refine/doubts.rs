//! What lengths and intrinsics that were taken at their word may be off by, and where the pose would go:
//! ARCHITECTURE.md, (7).

use super::offset_prior::{Covariance, FOCAL, Offsets, UnderOpenPrior, least, matters};
use super::priors::with_priors;
use super::start::OffsetDeviations;
use super::system::{Sum, System};
use crate::arm::MOST_JOINTS;
use crate::unknowns::{FIRST_JOINT, POSE, State, UNKNOWNS};
use nalgebra::{DMatrix, Matrix6};
use std::ops::Range;

/// What they are off by when they are off, standard deviations: lengths (m) of links that somebody measured or exchanged,
/// focal lengths (relative) and principal points (in focal lengths) of drivers that state a model's for those of the very
/// camera, and of images that were scaled or cut.
const OFF_LENGTH_M: f64 = 0.006;
const OFF_FOCAL: f64 = 0.02;
const OFF_PRINCIPAL_POINT: f64 = 0.008;

/// Something that description or recording may have wrong, and that was taken at its word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Doubt {
    /// By how much likelier what is seen would be if it were off by as much as such things are when they
    /// are off; logarithm.
    pub log_evidence: f64,
    /// Where the pose would go then: mean of the products of its shifts, translation (m) then rotation (rad).
    pub mean_square: Matrix6<f64>,
}

/// The doubts that remain of lengths and intrinsics at `state`, which came with `deviations`, by what is
/// said of the offsets under an `open` prior.
///
/// Of each that was taken at its word there are two models (a spike and a slab; Mitchell and Beauchamp, Journal of the
/// American Statistical Association 1988): right, or off by as much as such things are. Where nothing tells them apart,
/// the second is as likely as before, and it may be off by all of that.
pub(super) fn doubts(
    open: &UnderOpenPrior,
    system: &System<'_>,
    state: &State,
    deviations: &OffsetDeviations,
) -> Vec<Doubt> {
    let given = Offsets::from(deviations.numbers());
    let likelihood = open.log_likelihood(&given);
    let total = system.total();
    let doubtful = matters().filter(|matter| {
        matter.start >= MOST_JOINTS && matter.clone().all(|offset| given[offset] <= least(offset))
    });
    let doubt = |matter: Range<usize>| {
        let mut wide = given;
        matter.clone().for_each(|offset| wide[offset] = off_by(offset));
        let mut log_evidence = open.log_likelihood(&wide) - likelihood;
        if open.masked && matter.start >= FOCAL {
            // What speaks for it speaks as well for a mask that is a little too wide.
            log_evidence = log_evidence.min(0.0);
        }
        let square = posterior_square(open, &wide, &matter)?;
        let pose = pose_by(&total, state, &wide, &matter)?;
        let mean_square = &pose * square * pose.transpose();
        tracing::trace!(
            offset = matter.start,
            log_evidence,
            shift_mm = 1e3 * mean_square.view((0, 0), (3, 3)).trace().sqrt(),
            "a doubt"
        );
        Some(Doubt { log_evidence, mean_square: mean_square.fixed_view::<6, 6>(0, 0).into_owned() })
    };
    doubtful.filter_map(doubt).collect()
}

/// By how much a length or an intrinsic is off when it is off.
fn off_by(offset: usize) -> f64 {
    match offset {
        FOCAL => OFF_FOCAL,
        offset if offset > FOCAL => OFF_PRINCIPAL_POINT,
        _ => OFF_LENGTH_M,
    }
}

/// The mean square of the offsets of a `matter`, by what is seen of all and priors of these `deviations`.
fn posterior_square(
    open: &UnderOpenPrior,
    deviations: &Offsets,
    matter: &Range<usize>,
) -> Option<DMatrix<f64>> {
    let prior = Covariance::from_diagonal(&deviations.map(|d| d * d));
    let seen = (open.covariance + prior).cholesky()?;
    let mean = prior * seen.solve(&open.offsets);
    let left = prior - prior * seen.solve(&prior);
    let square = mean * mean.transpose() + left;
    let (first, count) = (matter.start, matter.len());
    Some(square.view((first, first), (count, count)).into_owned())
}

/// How the pose follows the offsets of a `matter`, by one of each, if all else is as likely as can be.
fn pose_by(
    total: &Sum,
    state: &State,
    deviations: &Offsets,
    matter: &Range<usize>,
) -> Option<DMatrix<f64>> {
    let deviations = OffsetDeviations::from_fn(|offset| deviations[offset]);
    let information = with_priors(total.clone(), state, &deviations).information;
    let (first, count) = (FIRST_JOINT + matter.start, matter.len());
    let chosen =
        DMatrix::from_fn(UNKNOWNS, count, |row, column| f64::from(u8::from(row == first + column)));
    let columns = information.cholesky()?.solve(&chosen);
    let own = columns.rows(first, count).into_owned().try_inverse()?;
    Some(columns.rows(0, POSE) * own)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::unknowns::{OFFSETS, Unknowns};
    use eyebolt_geometry::{Base, Camera, Transform};
    use nalgebra::Vector3;

    /// What is seen of one offset: `value`, up to `sigma`.
    fn seen(offset: usize, value: f64, sigma: f64) -> UnderOpenPrior {
        let mut covariance = Covariance::identity() * 1e-8;
        covariance[(offset, offset)] = sigma * sigma;
        UnderOpenPrior { offsets: Offsets::ith(offset, value), covariance, masked: false }
    }

    fn square(value: f64, sigma: f64, prior: f64) -> f64 {
        let deviations = Offsets::from_fn(|offset, _| if offset == FOCAL { prior } else { 1e-4 });
        let all = posterior_square(&seen(FOCAL, value, sigma), &deviations, &(FOCAL..FOCAL + 1));
        all.unwrap()[(0, 0)]
    }

    #[test]
    fn what_is_seen_and_what_is_usual_make_the_square() {
        for (value, sigma, prior) in [(0.01, 0.004, 0.02), (-0.03, 0.02, 0.02), (0.0, 0.1, 0.01)] {
            let share = prior * prior / (prior * prior + sigma * sigma);
            let expected = (share * value) * (share * value) + share * sigma * sigma;
            assert!((square(value, sigma, prior) / expected - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn where_nothing_is_seen_it_is_what_is_usual_and_where_all_is_seen_what_is_seen() {
        assert!((square(0.0, 100.0, 0.02).sqrt() - 0.02).abs() < 1e-6);
        assert!((square(0.015, 1e-6, 0.02).sqrt() - 0.015).abs() < 1e-6);
    }

    /// Sums of residuals that depend on all unknowns.
    fn sum() -> Sum {
        let mut sum = Sum::default();
        for row in 0..4 * UNKNOWNS {
            let jacobian = Unknowns::from_fn(|i, _| ((row * 31 + i * 17 + row * i) as f64).sin());
            sum.add(&jacobian, 0.0, 1.0);
        }
        sum
    }

    #[test]
    fn the_pose_goes_where_all_else_is_most_likely() {
        let camera_from_base = Transform::<Camera, Base>::from_parts(
            Vector3::new(0.1, 0.2, 1.3),
            nalgebra::UnitQuaternion::identity(),
        );
        let state = State::from(crate::refine::Start::from(camera_from_base));
        let deviations = Offsets::repeat(0.01);
        let matter = FOCAL + 1..OFFSETS;
        let found = pose_by(&sum(), &state, &deviations, &matter).unwrap();
        // With both numbers held, the rest of the unknowns are another problem.
        let wide = OffsetDeviations::from_fn(|_| 0.01);
        let information = with_priors(sum(), &state, &wide).information;
        const REST: usize = UNKNOWNS - 2;
        let rest = information.fixed_view::<REST, REST>(0, 0).into_owned();
        let across = information.fixed_view::<REST, 2>(0, REST).into_owned();
        let expected = -rest.cholesky().unwrap().solve(&across);
        assert!((found - expected.rows(0, POSE)).amax() < 1e-9);
    }
}
