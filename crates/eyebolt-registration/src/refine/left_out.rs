//! What the answer would be without one of its views: ARCHITECTURE.md, (9).

use super::priors::with_priors;
use super::start::Start;
use super::system::System;
use crate::arm::MOST_JOINTS;
use crate::unknowns::State;

/// One Newton step from the answer at `state` on the problem without each of `views` views in turn:
/// the residuals are those of the answer, so the cost is that of a linear system for each view.
/// `curved` has Newton's matrix, and `system` serves where that is not positive definite.
///
/// Empty if the views but one do not determine the pose.
pub(super) fn without_each(
    system: &System<'_>,
    curved: &System<'_>,
    state: &State,
    joint_prior_rad: &[f64; MOST_JOINTS],
    views: usize,
) -> Vec<Start> {
    let (total, curved_total) = (system.total(), curved.total());
    let without = |view: usize| {
        let newton = curved.total_without(view, &curved_total);
        let step = with_priors(newton, state, joint_prior_rad).solve(1e-6).or_else(|| {
            let reweighted = system.total_without(view, &total);
            with_priors(reweighted, state, joint_prior_rad).solve(1e-6)
        })?;
        let left = state.stepped(&step);
        Some(Start { camera_from_base: left.camera_from_base, joint_offsets: left.joint_offsets })
    };
    (0..views).map(without).collect::<Option<Vec<_>>>().unwrap_or_default()
}
