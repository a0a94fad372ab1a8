//! From a rough pose to an exact one: label, register, label again.

use crate::label::{arm_points, labels_at};
use crate::observations::Observations;
use eyebolt_registration::{
    Labels, OffsetDeviations, OffsetPrior, Reach, RefineOptions, RefineView, Refinement,
    Silhouette, Start, Trust, View,
};
use eyebolt_render::Raster;
use rayon::prelude::*;

/// Points on surfaces that a configuration contributes.
const POINTS: usize = 1200;

/// Centimetres away, joints or intrinsics that are off would be anything.
const AT_THEIR_WORD: OffsetPrior = OffsetPrior::Known(OffsetDeviations::NONE);

/// From a start that may be centimetres off to one that is within the reach of [`CLOSING`].
pub const OPENING: &[RefineOptions] =
    &[RefineOptions { offset_prior: AT_THEIR_WORD, ..options(4, Reach::Far) }];

/// From there to the answer.
pub const CLOSING: &[RefineOptions] =
    &[options(5, Reach::Near), RefineOptions { in_full: true, ..options(20, Reach::Close) }];

/// From an answer to what it would be with other data, in so many steps.
pub const fn again(iterations: usize) -> RefineOptions {
    options(iterations, Reach::Close)
}

const fn options(iterations: usize, reach: Reach) -> RefineOptions {
    let (trust, offset_prior) = (Trust::All, OffsetPrior::Estimated);
    RefineOptions { iterations, reach, trust, offset_prior, in_full: false }
}

/// Labels and points of each of `views` with the arm posed as `start` has it.
pub fn observe<'a>(
    observations: &Observations,
    views: &[View<'a>],
    rasters: &mut [Raster],
    start: &Start,
) -> Vec<RefineView<'a>> {
    let pairs = views.par_iter().zip(rasters.par_iter_mut());
    pairs.map(|(view, raster)| observe_one(observations, view, raster, start).0).collect()
}

/// What the refinement looks at in one view with the arm posed as `start` has it, and its labels.
pub fn observe_one<'a>(
    observations: &Observations,
    view: &View<'a>,
    raster: &mut Raster,
    start: &Start,
) -> (RefineView<'a>, Labels) {
    let (arm, rays) = (&observations.arm, &observations.rays);
    let posture = &view.posture.moved(arm, &start.joint_offsets);
    let posed = View { posture, depth_factor: start.depth_factor(), ..*view };
    let labels = labels_at(arm, &posed, rays, raster, &start.camera_from_base);
    let ((arm_points, pixels_per_point), silhouette) =
        rayon::join(|| arm_points(&labels, view, rays, POINTS), || Silhouette::new(&labels));
    (RefineView { view: *view, arm_points, pixels_per_point, silhouette }, labels)
}

/// Refines `start` on `views` in `rounds`, labelling anew before each; also returns what the last
/// round saw.
///
/// # Panics
///
/// If there are no rounds.
pub fn refine<'a>(
    observations: &Observations,
    views: &[View<'a>],
    rasters: &mut [Raster],
    start: &Start,
    rounds: &[RefineOptions],
) -> (Refinement, Vec<RefineView<'a>>) {
    let mut start = *start;
    let mut last = None;
    for options in rounds {
        let observed = observe(observations, views, rasters, &start);
        let refinement =
            eyebolt_registration::refine(&observations.arm, &observed, rasters, &start, options);
        start = refinement.end();
        last = Some((refinement, observed));
    }
    last.expect("at least one round")
}
