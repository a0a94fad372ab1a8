//! The factors of one step, in buffers that are kept from step to step.

use super::start::RefineView;
use crate::arm::ArmModel;
use crate::evidence::{EvidenceKind, Factor, KINDS, PosedArm, PosedView};
use crate::robust::median;
use crate::unknowns::{EVIDENCE_KINDS, State};
use eyebolt_render::Raster;
use rayon::prelude::*;

/// Factors of one view at one state.
#[derive(Clone, Default)]
pub(super) struct ViewFactors {
    /// By kind of evidence.
    pub factors: [Vec<Factor>; EVIDENCE_KINDS],
    /// How many samples each factor stands for, by kind.
    pub samples: [f64; EVIDENCE_KINDS],
    /// Points of the arm.
    pub points: usize,
    /// Whether its outline is that of a mask.
    pub masked: bool,
}

/// Gathers the factors of all views at `state`.
pub(super) fn gather(
    arm: &ArmModel,
    views: &[RefineView<'_>],
    rasters: &mut [Raster],
    state: &State,
    gathered: &mut [ViewFactors],
) {
    let work = views.par_iter().zip(rasters.par_iter_mut()).zip(gathered.par_iter_mut());
    work.for_each(|((view, raster), gathered)| gather_one(arm, view, raster, state, gathered));
}

pub(super) fn gather_one(
    arm: &ArmModel,
    view: &RefineView<'_>,
    raster: &mut Raster,
    state: &State,
    gathered: &mut ViewFactors,
) {
    let camera = view.view.camera;
    let posture = &view.view.posture.moved(arm, &state.joint_offsets);
    let undrawn = PosedView {
        posed: PosedArm { arm, posture, state },
        camera,
        arm_points: &view.arm_points,
        pixels_per_point: view.pixels_per_point,
        silhouette: &view.silhouette,
        raster: None,
    };
    gathered.points = view.arm_points.len();
    gathered.masked = view.view.mask.is_some();
    let kinds = gathered.factors.iter_mut().zip(&mut gathered.samples).zip(KINDS);
    let (drawn, without): (Vec<_>, Vec<_>) = kinds.partition(|(_, kind)| kind.needs_drawing());
    let gather = |kinds: Vec<Buffers<'_>>, posed: &PosedView<'_>| {
        for ((factors, samples), kind) in kinds {
            factors.clear();
            *samples = kind.gather(posed, factors);
        }
    };
    // Few views and few cores: the halves of a view keep all of them busy to the end.
    rayon::join(
        || gather(without, &undrawn),
        || {
            raster.draw(camera, &posture.meshes(arm, &state.camera_from_base));
            gather(drawn, &PosedView { raster: Some(raster), ..undrawn });
        },
    );
}

/// Where one kind of evidence puts its factors, and what they stand for.
type Buffers<'a> = ((&'a mut Vec<Factor>, &'a mut f64), &'static dyn EvidenceKind);

/// Standard deviation of each kind's residuals that are within twice its robust scale, from their
/// median size (1.4826 times it, as of a Gaussian).
pub(super) fn deviations(
    gathered: &[ViewFactors],
    scales: &[f64; EVIDENCE_KINDS],
) -> [f64; EVIDENCE_KINDS] {
    std::array::from_fn(|kind| {
        let sizes = gathered.iter().flat_map(|view| &view.factors[kind]).map(|f| f.residual.abs());
        let mut near: Vec<f64> = sizes.filter(|size| *size < 2.0 * scales[kind]).collect();
        let least = KINDS[kind].least_deviation();
        median(&mut near).map_or(least, |median| (1.4826 * median).max(least))
    })
}
