//! What each kind of evidence would say alone: what is wrong in every frame alike shows where they
//! disagree.

use crate::refine::{Workspace, again};
use eyebolt_registration::{
    EVIDENCE_KINDS, OffsetPrior, RefineOptions, RefineView, Refinement, Trust,
};
use eyebolt_render::Raster;
use nalgebra::{SMatrix, SVector};
use rayon::prelude::*;

/// Steps from the answer of all kinds to that of one. With five, the disagreement on the recordings of
/// real arms is up to a fifth smaller: not settled yet.
const STEPS: usize = 8;

/// What each kind of evidence that was seen makes of `refinement` alone, with joints as likely to
/// be off; `None` if there are not two.
pub(super) fn one_kind_each(
    work: &mut Workspace<'_, '_>,
    seen: &[RefineView<'_>],
    refinement: &Refinement,
) -> Option<Vec<Refinement>> {
    let was_seen = |kind: &usize| refinement.views.iter().any(|v| v.fits[*kind].median.is_some());
    let kinds: Vec<usize> = (0..EVIDENCE_KINDS).filter(was_seen).collect();
    if kinds.len() < 2 {
        return None;
    }
    let (arm, camera) = (&work.observations.arm, &work.observations.camera);
    let mut rasters = vec![std::mem::take(&mut work.rasters)];
    rasters.resize_with(kinds.len(), || seen.iter().map(|_| Raster::new(camera)).collect());
    // Side by side, since a few views keep no more than a few cores busy.
    let alone = |(kind, rasters): (&usize, &mut Vec<Raster>)| {
        let offset_prior = OffsetPrior::Known(refinement.offset_prior);
        let options = RefineOptions { trust: Trust::Only(*kind), offset_prior, ..again(STEPS) };
        eyebolt_registration::refine(arm, seen, rasters, &refinement.end(), &options)
    };
    let ends = kinds.par_iter().zip(&mut rasters).map(alone).collect();
    work.rasters = rasters.swap_remove(0);
    Some(ends)
}

/// Mean square of `deltas` about their mean: of two, half of their difference squared.
pub(super) fn spread<const N: usize>(deltas: &[SVector<f64, N>]) -> SMatrix<f64, N, N> {
    let count = deltas.len() as f64;
    let mean = deltas.iter().sum::<SVector<f64, N>>() / count;
    let squares = deltas.iter().map(|d| (d - mean) * (d - mean).transpose());
    squares.sum::<SMatrix<f64, N, N>>() / count
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector2;

    #[test]
    fn of_two_it_is_half_of_their_difference() {
        let (a, b) = (Vector2::new(1.0, -2.0), Vector2::new(0.5, 3.0));
        let half = 0.5 * (a - b);
        assert!((spread(&[a, b]) - half * half.transpose()).amax() < 1e-12);
    }
}
