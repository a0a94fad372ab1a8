//! Gaussian priors of the unknowns that have one: ARCHITECTURE.md, (6).

use super::start::OffsetDeviations;
use super::system::Sum;
use crate::evidence::KINDS;
use crate::unknowns::{FIRST_JOINT, FIRST_NUISANCE, State, Unknowns};

/// An unknown that is `value` away from the mean of its prior of this standard deviation.
pub(super) struct Prior {
    pub unknown: usize,
    pub value: f64,
    pub deviation: f64,
}

/// Which unknowns have a prior, and where they are in it.
pub(super) fn priors(state: &State, deviations: &OffsetDeviations) -> impl Iterator<Item = Prior> {
    let nuisances = state.nuisances.into_iter().zip(KINDS).enumerate();
    let of_kind =
        |(kind, (value, evidence)): (usize, (f64, &dyn crate::evidence::EvidenceKind))| {
            let deviation = evidence.nuisance_deviation();
            Prior { unknown: FIRST_NUISANCE + kind, value, deviation }
        };
    let offsets = state.offsets().into_iter().zip(deviations.numbers()).enumerate();
    let of_offset =
        |(offset, (value, deviation))| Prior { unknown: FIRST_JOINT + offset, value, deviation };
    nuisances.map(of_kind).chain(offsets.map(of_offset))
}

/// `sum` with the priors added.
pub(super) fn with_priors(mut sum: Sum, state: &State, deviations: &OffsetDeviations) -> Sum {
    for prior in priors(state, deviations) {
        sum.add(&Unknowns::ith(prior.unknown, 1.0), prior.value, prior.deviation.powi(-2));
    }
    sum
}
