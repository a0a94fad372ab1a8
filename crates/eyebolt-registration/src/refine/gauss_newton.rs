//! The iteration.

use super::clusters::{Cluster, clusters};
use super::gather::{ViewFactors, deviations, gather};
use super::offset_prior;
use super::outcome::{Refinement, StopReason};
use super::priors::with_priors;
use super::start::{OffsetDeviations, OffsetPrior, RefineOptions, RefineView, Start};
use super::summary::{Ending, summarise};
use super::system::{Matrix, System, Weights};
use crate::arm::ArmModel;
use crate::evidence::KINDS;
use crate::unknowns::{EVIDENCE_KINDS, POSE, State, Unknowns};
use eyebolt_render::Raster;
use nalgebra::Vector6;

/// Refines the pose from `start` on all `views`: ARCHITECTURE.md, (1).
///
/// Alternates between drawing the posed arm for its contour and one Gauss-Newton step on the
/// residuals of all kinds of evidence, each under Geman and McClure's weight, along with their
/// nuisance parameters and the joints' offsets under priors. `rasters`: one for each view, of its
/// camera's size.
pub fn refine(
    arm: &ArmModel,
    views: &[RefineView<'_>],
    rasters: &mut [Raster],
    start: &Start,
    options: &RefineOptions,
) -> Refinement {
    let clusters = clusters(views);
    let mut gathered = vec![ViewFactors::default(); views.len()];
    let mut state = State::from(*start);
    let mut scales = KINDS.map(|kind| kind.first_scale(options.reach));
    let mut ending =
        Ending { iterations: 0, last_step: Vector6::zeros(), stop: StopReason::IterationLimit };
    gather(arm, views, rasters, &state, &mut gathered);
    while ending.iterations < options.iterations {
        ending.iterations += 1;
        let weights = weights(&gathered, &scales, options);
        let system = System::new(&gathered, &clusters, &weights, Matrix::Reweighted);
        let deviations = offset_deviations(arm, &system, &state, options);
        let Some(step) = with_priors(system.total(), &state, &deviations).solve(1e-6) else {
            ending.stop = StopReason::Underdetermined;
            break;
        };
        ending.last_step = step.fixed_rows::<POSE>(0).into_owned();
        tracing::trace!(
            iteration = ending.iterations,
            step_mm = 1e3 * step.fixed_rows::<3>(0).norm(),
            step_deg = step.fixed_rows::<3>(3).norm().to_degrees(),
            deviations = ?weights.deviations,
            scales = ?weights.scales,
            "step"
        );
        state = state.stepped(&step);
        gather(arm, views, rasters, &state, &mut gathered);
        let final_scales = final_scales(&weights.deviations);
        let settled = (0..EVIDENCE_KINDS).all(|kind| scales[kind] <= SETTLED * final_scales[kind]);
        if settled && negligible(&step) {
            ending.stop = StopReason::Converged;
            break;
        }
        for (scale, least) in scales.iter_mut().zip(final_scales) {
            *scale = (SHRINK * *scale).max(least);
        }
    }
    finish(arm, &gathered, &clusters, &scales, &state, options, ending)
}

/// A kernel this near to its final scale is there.
const SETTLED: f64 = 3.01 / 3.0;
/// Of a kernel's scale, from one step to the next.
const SHRINK: f64 = 0.6;

fn finish(
    arm: &ArmModel,
    gathered: &[ViewFactors],
    clusters: &[Vec<Cluster>],
    scales: &[f64; EVIDENCE_KINDS],
    state: &State,
    options: &RefineOptions,
    ending: Ending,
) -> Refinement {
    let weights = weights(gathered, scales, options);
    let system = System::new(gathered, clusters, &weights, Matrix::Reweighted);
    let curved =
        options.in_full.then(|| System::new(gathered, clusters, &weights, Matrix::Curvature));
    let deviations = offset_deviations(arm, &system, state, options);
    summarise(gathered, &system, curved.as_ref(), &weights, state, &deviations, ending)
}

fn weights(
    gathered: &[ViewFactors],
    scales: &[f64; EVIDENCE_KINDS],
    options: &RefineOptions,
) -> Weights {
    let deviations = deviations(gathered, scales);
    Weights { scales: *scales, deviations, trust: options.trust }
}

/// Three standard deviations of each kind's residuals: what lies beyond counts little.
pub(super) fn final_scales(deviations: &[f64; EVIDENCE_KINDS]) -> [f64; EVIDENCE_KINDS] {
    std::array::from_fn(|kind| 3.0 * deviations[kind].max(KINDS[kind].least_kernel_deviation()))
}

fn offset_deviations(
    arm: &ArmModel,
    system: &System<'_>,
    state: &State,
    options: &RefineOptions,
) -> OffsetDeviations {
    match options.offset_prior {
        OffsetPrior::Known(deviations) => deviations,
        OffsetPrior::Estimated => {
            let gauge = |joint: usize| arm.joints().get(joint).is_some_and(|j| j.defines_base);
            offset_prior::estimate(system, state, std::array::from_fn(gauge))
        }
    }
}

/// The contour is drawn to whole pixels: below a tenth of a millimetre and 0.01 degrees steps only
/// follow its jitter.
fn negligible(step: &Unknowns) -> bool {
    step.fixed_rows::<3>(0).norm() < 1.0e-4 && step.fixed_rows::<3>(3).norm() < 1.75e-4
}
