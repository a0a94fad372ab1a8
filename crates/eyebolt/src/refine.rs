//! From a rough pose to an exact one: label, register, label again.

use crate::label::{arm_points, labels_at};
use crate::session::Session;
use eyebolt_registration::{
    JointPrior, MOST_JOINTS, RefineOptions, RefineView, Refinement, Silhouette, Start, Trust, View,
};
use eyebolt_render::Raster;
use rayon::prelude::*;

/// Points on surfaces that a configuration contributes.
const POINTS: usize = 1200;

/// Centimetres away, joints that are off would be anything.
const AT_THEIR_WORD: JointPrior = JointPrior::Known { rad: [1e-5; MOST_JOINTS] };

/// From a start that may be centimetres off to one that is within the reach of [`CLOSING`].
pub const OPENING: &[RefineOptions] =
    &[RefineOptions { joint_prior: AT_THEIR_WORD, ..options(4, 0.06, 20.0) }];

/// From there to the answer.
pub const CLOSING: &[RefineOptions] = &[options(5, 0.03, 8.0), options(20, 0.02, 4.0)];

/// From an answer to what it would be with less data.
pub const LEAVE_ONE_OUT: RefineOptions = options(6, 0.02, 4.0);

/// From an answer to what one kind of evidence alone would make of it.
pub const ONE_SIDED: RefineOptions = options(8, 0.02, 4.0);

const fn options(iterations: usize, surface_scale_m: f64, outline_scale_px: f64) -> RefineOptions {
    let joint_prior = JointPrior::Estimated;
    RefineOptions { iterations, surface_scale_m, outline_scale_px, trust: Trust::Both, joint_prior }
}

/// Drawing buffers, one for each configuration.
pub fn rasters(session: &Session) -> Vec<Raster> {
    session.configurations.iter().map(|_| Raster::new(&session.camera)).collect()
}

/// Labels and points of each of `views` with the arm posed as `start` has it.
pub fn observe<'a>(
    session: &Session,
    views: &[View<'a>],
    rasters: &mut [Raster],
    start: &Start,
) -> Vec<RefineView<'a>> {
    let pairs = views.par_iter().zip(rasters.par_iter_mut());
    pairs
        .map(|(view, raster)| {
            let (arm, rays) = (&session.arm, &session.rays);
            let posture = &view.posture.moved(arm, &start.joint_offsets);
            let posed = View { posture, ..*view };
            let labels = labels_at(arm, &posed, rays, raster, &start.camera_from_base);
            let (arm_points, pixels_per_point) = arm_points(&labels, view, rays, POINTS);
            let silhouette = Silhouette::new(&labels);
            RefineView { view: *view, arm_points, pixels_per_point, silhouette }
        })
        .collect()
}

/// Refines `start` on `views` in `rounds`, labelling anew before each; also returns what the last
/// round saw.
///
/// # Panics
///
/// If there are no rounds.
pub fn refine<'a>(
    session: &Session,
    views: &[View<'a>],
    rasters: &mut [Raster],
    start: &Start,
    rounds: &[RefineOptions],
) -> (Refinement, Vec<RefineView<'a>>) {
    let mut start = *start;
    let mut last = None;
    for options in rounds {
        let observed = observe(session, views, rasters, &start);
        let refinement =
            eyebolt_registration::refine(&session.arm, &observed, rasters, &start, options);
        start = refinement.end();
        last = Some((refinement, observed));
    }
    last.expect("at least one round")
}
