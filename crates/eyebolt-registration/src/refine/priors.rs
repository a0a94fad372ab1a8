//! Gaussian priors of the unknowns that have one: ARCHITECTURE.md, (6).

use super::system::Sum;
use crate::arm::MOST_JOINTS;
use crate::evidence::KINDS;
use crate::unknowns::{FIRST_JOINT, FIRST_NUISANCE, State, Unknowns};

/// An unknown that is `value` away from the mean of its prior of this standard deviation.
pub(super) struct Prior {
    pub unknown: usize,
    pub value: f64,
    pub deviation: f64,
}

/// Which unknowns have a prior, and where they are in it.
pub(super) fn priors(
    state: &State,
    joint_prior_rad: &[f64; MOST_JOINTS],
) -> impl Iterator<Item = Prior> {
    let nuisances = state.nuisances.into_iter().zip(KINDS).enumerate();
    let of_kind =
        |(kind, (value, evidence)): (usize, (f64, &dyn crate::evidence::EvidenceKind))| {
            let deviation = evidence.nuisance_deviation();
            Prior { unknown: FIRST_NUISANCE + kind, value, deviation }
        };
    let joints = state.joint_offsets.rad.into_iter().zip(*joint_prior_rad).enumerate();
    let of_joint =
        |(joint, (value, deviation))| Prior { unknown: FIRST_JOINT + joint, value, deviation };
    nuisances.map(of_kind).chain(joints.map(of_joint))
}

/// `sum` with the priors added.
pub(super) fn with_priors(
    mut sum: Sum,
    state: &State,
    joint_prior_rad: &[f64; MOST_JOINTS],
) -> Sum {
    for prior in priors(state, joint_prior_rad) {
        sum.add(&Unknowns::ith(prior.unknown, 1.0), prior.value, prior.deviation.powi(-2));
    }
    sum
}
