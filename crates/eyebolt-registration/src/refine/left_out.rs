//! What the answer would be without some of its views: ARCHITECTURE.md, (10).

use super::covariance::determines_all;
use super::priors::with_priors;
use super::start::{OffsetDeviations, Start};
use super::system::System;
use crate::unknowns::State;

/// With more views than this, they are also left out in so many groups.
const MOST_ALONE: usize = 10;

/// The answer without some views, by one Newton step from the full one.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOut {
    /// The views that were left out.
    pub views: Vec<usize>,
    /// Where that step leads.
    pub(super) state: State,
}

impl LeftOut {
    /// The pose and the joint offsets there.
    pub fn first_step(&self) -> Start {
        self.state.into()
    }
}

/// What the answer at `state` would be without each of `views` views in turn, and of many also
/// without each of ten groups of them.
///
/// The residuals are those of the full answer, so the cost is that of a linear system each. `curved`
/// has Newton's matrix, and `system` serves where that is not positive definite. Empty where the
/// rest does not determine the pose.
pub(super) fn without_each(
    system: &System<'_>,
    curved: &System<'_>,
    state: &State,
    deviations: &OffsetDeviations,
    views: usize,
) -> [Vec<LeftOut>; 2] {
    let totals = [curved.total(), system.total()];
    let clusters = [curved, system].map(System::cluster_totals);
    let without = |views: Vec<usize>| {
        let rest = |system: &System<'_>, number: usize| {
            let rest = system.total_without(&views, &totals[number], &clusters[number]);
            with_priors(rest, state, deviations)
        };
        let reweighted = rest(system, 1);
        if !determines_all(&reweighted.information) {
            return None;
        }
        let step = rest(curved, 0).solve(1e-6).or_else(|| reweighted.solve(1e-6))?;
        Some(LeftOut { views, state: state.stepped(&step) })
    };
    let alone = (0..views).map(|view| without(vec![view])).collect::<Option<Vec<_>>>();
    // Every tenth view: neighbours in time are in different groups.
    let group = |first| (first..views).step_by(MOST_ALONE).collect();
    let groups = if views > MOST_ALONE { 0..MOST_ALONE } else { 0..0 };
    let groups = groups.map(|first| without(group(first))).collect::<Option<Vec<_>>>();
    [alone.unwrap_or_default(), groups.unwrap_or_default()]
}
