//! What a refinement comes to: fits, information, covariance.

use super::covariance::sandwich;
use super::doubts::doubts;
use super::gather::ViewFactors;
use super::left_out::without_each;
use super::offset_prior::{UnderOpenPrior, under_open_prior};
use super::outcome::{Fit, Refinement, StopReason, ViewFit};
use super::priors::with_priors;
use super::start::OffsetDeviations;
use super::system::{System, Weights};
use crate::arm::MOST_JOINTS;
use crate::robust::median;
use crate::unknowns::{EVIDENCE_KINDS, State, Unknowns};
use nalgebra::{Matrix6, Vector6};

/// How an iteration ended.
pub(super) struct Ending {
    pub iterations: usize,
    pub last_step: Vector6<f64>,
    pub stop: StopReason,
}

/// The outcome of a refinement that ended at `state`; `curved` has the sums of `system` with Newton's
/// matrix, if it is asked for in full.
pub(super) fn summarise(
    gathered: &[ViewFactors],
    system: &System<'_>,
    curved: Option<&System<'_>>,
    weights: &Weights,
    state: &State,
    deviations: &OffsetDeviations,
    ending: Ending,
) -> Refinement {
    let sum = with_priors(system.total(), state, deviations);
    let all = sandwich(system, &sum, state, deviations, &Unknowns::zeros());
    let covariance = all.map(|all| all.fixed_view::<6, 6>(0, 0).into_owned());
    let inverse = sum.information.try_inverse();
    let information = inverse
        .and_then(|c| c.fixed_view::<6, 6>(0, 0).into_owned().try_inverse())
        .unwrap_or_else(Matrix6::zeros);
    let [left_out, groups_left_out] = curved.map_or_else(Default::default, |curved| {
        without_each(system, curved, state, deviations, gathered.len())
    });
    let open = under_open_prior(system, state);
    let Ending { iterations, last_step, stop } = ending;
    Refinement {
        camera_from_base: state.camera_from_base,
        joint_offsets: state.joint_offsets,
        joint_sigma_rad: joint_sigma(open.as_ref(), state),
        intrinsics: state.intrinsics,
        offset_prior: *deviations,
        doubts: open
            .filter(|_| curved.is_some())
            .map_or_else(Vec::new, |open| doubts(&open, system, state, deviations)),
        nuisances: state.nuisances,
        information,
        covariance: covariance.unwrap_or_else(|| Matrix6::from_element(f64::INFINITY)),
        deviations: weights.deviations,
        views: gathered.iter().map(|view| view_fit(view, &weights.deviations)).collect(),
        left_out,
        groups_left_out,
        iterations,
        last_step,
        stop: if covariance.is_none() { StopReason::Underdetermined } else { stop },
    }
}

/// What the prior took off an offset is as likely an error of it as the deviation of what is seen.
fn joint_sigma(open: Option<&UnderOpenPrior>, state: &State) -> [f64; MOST_JOINTS] {
    let Some(UnderOpenPrior { offsets, covariance, .. }) = open else {
        return [f64::INFINITY; MOST_JOINTS];
    };
    std::array::from_fn(|joint| {
        let taken_off = offsets[joint] - state.joint_offsets.rad[joint];
        covariance[(joint, joint)].sqrt().hypot(taken_off)
    })
}

pub(super) fn view_fit(view: &ViewFactors, deviations: &[f64; EVIDENCE_KINDS]) -> ViewFit {
    let fits = std::array::from_fn(|kind| {
        let mut sizes: Vec<f64> = view.factors[kind].iter().map(|f| f.residual.abs()).collect();
        let inliers = sizes.iter().filter(|size| **size < 3.0 * deviations[kind]).count();
        Fit { median: median(&mut sizes), inliers }
    });
    ViewFit { fits, points: view.points }
}
