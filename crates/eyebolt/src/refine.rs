//! From a rough pose to an exact one: label, register, label again.

use crate::label::{arm_points, labels_at};
use crate::session::Session;
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::{RefineOptions, RefineView, Refinement, Silhouette, View};
use eyebolt_render::Raster;
use rayon::prelude::*;

/// Points on surfaces that a configuration contributes.
const POINTS: usize = 1200;

/// Rounds from a start that may be centimetres off.
pub const FROM_AFAR: &[RefineOptions] = &[
    RefineOptions { iterations: 4, surface_scale_m: 0.06, outline_scale_px: 20.0 },
    RefineOptions { iterations: 5, surface_scale_m: 0.03, outline_scale_px: 8.0 },
    RefineOptions { iterations: 15, surface_scale_m: 0.02, outline_scale_px: 4.0 },
];

/// Rounds from a start that is right already, or nearly so.
pub const FROM_NEARBY: &[RefineOptions] =
    &[RefineOptions { iterations: 15, surface_scale_m: 0.02, outline_scale_px: 5.0 }];

/// Drawing buffers, one for each configuration.
pub fn rasters(session: &Session) -> Vec<Raster> {
    session.configurations.iter().map(|_| Raster::new(&session.camera)).collect()
}

/// Labels and points of each of `views` with the arm posed at `camera_from_base`.
pub fn observe<'a>(
    session: &Session,
    views: &[View<'a>],
    rasters: &mut [Raster],
    camera_from_base: &Transform<Camera, Base>,
) -> Vec<RefineView<'a>> {
    let pairs = views.par_iter().zip(rasters.par_iter_mut());
    pairs
        .map(|(view, raster)| {
            let rays = &session.rays;
            let labels = labels_at(&session.arm, view, rays, raster, camera_from_base);
            let (arm_points, pixels_per_point) = arm_points(&labels, view, rays, POINTS);
            let silhouette = Silhouette::new(&labels);
            RefineView { view: *view, arm_points, pixels_per_point, silhouette }
        })
        .collect()
}

/// Refines `start` on `views` in `rounds`, labelling anew before each.
///
/// # Panics
///
/// If there are no rounds.
pub fn refine(
    session: &Session,
    views: &[View<'_>],
    rasters: &mut [Raster],
    start: &Transform<Camera, Base>,
    rounds: &[RefineOptions],
) -> Refinement {
    let mut refinement: Option<Refinement> = None;
    for options in rounds {
        let pose = refinement.as_ref().map_or(*start, |r| r.camera_from_base);
        let observed = observe(session, views, rasters, &pose);
        refinement =
            Some(eyebolt_registration::refine(&session.arm, &observed, rasters, &pose, options));
    }
    refinement.expect("at least one round")
}
