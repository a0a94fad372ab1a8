//! What the answer leaves over: how far each configuration's points and outline are from the posed
//! arm, as the refinement measures it.

use crate::label::{arm_points, labels_at};
use crate::session::{Configuration, Session};
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::{Labels, Refinement, Silhouette, View};
use eyebolt_render::{Raster, outer_contour};
use nalgebra::Point3;
use rayon::prelude::*;

/// Points looked at in a configuration, as many as the refinement looks at.
const POINTS: usize = 1200;
/// Places of the contour looked at.
const CONTOUR_POINTS: usize = 1500;

/// What one configuration leaves over.
#[derive(Clone, Debug)]
pub(super) struct Leftover {
    /// What each pixel about the arm is taken for.
    pub(super) labels: Labels,
    /// Link, and how far behind its surface a point was seen (in front of it if negative),
    /// millimetres.
    pub(super) surface_mm: Vec<(usize, f32)>,
    /// How far the drawn contour is outside the outline seen (inside if negative), pixels.
    pub(super) outline_px: Vec<f32>,
}

/// What every configuration of `session` leaves over, those that took no part too.
///
/// As in the refinement, depth is scaled and the outline narrowed by what fits best.
pub(super) fn leftovers(session: &Session, refinement: &Refinement) -> Vec<Leftover> {
    session.configurations.par_iter().map(|c| leftover(session, c, refinement)).collect()
}

fn leftover(session: &Session, configuration: &Configuration, refinement: &Refinement) -> Leftover {
    let pose = &refinement.camera_from_base;
    let view = session.view(configuration);
    let mut raster = Raster::new(&session.camera);
    let labels = labels_at(&session.arm, &view, &session.rays, &mut raster, pose);
    let scale = (1.0 + refinement.depth_scale) as f32;
    let (points, _) = arm_points(&labels, &view, &session.rays, POINTS);
    let surface_mm =
        points.iter().filter_map(|p| behind(session, &view, pose, &(p * scale))).collect();
    let outline_px = outline_px(&view, &raster, &Silhouette::new(&labels), refinement.outline_px);
    Leftover { labels, surface_mm, outline_px }
}

/// The nearest link and how far behind its surface `point_in_camera` is, millimetres; `None` where
/// that surface faces away, so that the camera cannot have seen it.
fn behind(
    session: &Session,
    view: &View<'_>,
    pose: &Transform<Camera, Base>,
    point_in_camera: &Point3<f32>,
) -> Option<(usize, f32)> {
    let point_in_base = pose.isometry().inverse_transform_point(&point_in_camera.cast()).cast();
    let nearest = view.posture.nearest(&session.arm, &point_in_base)?;
    let normal = pose.direction(&nearest.gradient_in_base.cast());
    let faces_away = normal.dot(&point_in_camera.coords.cast()) > 0.0;
    (!faces_away).then_some((nearest.link, -1e3 * nearest.distance_m))
}

fn outline_px(
    view: &View<'_>,
    raster: &Raster,
    silhouette: &Silhouette,
    excess_px: f64,
) -> Vec<f32> {
    let contour = outer_contour(raster, view.camera);
    let stride = contour.len().div_ceil(CONTOUR_POINTS).max(1);
    let places = contour.iter().step_by(stride);
    places
        .filter_map(|place| {
            let (distance_px, gradient) = silhouette.sample(&place.pixel)?;
            // The nearest outline is another edge if it does not run along.
            let along = gradient.dot(&place.outward) >= 0.5;
            along.then_some(distance_px + excess_px as f32)
        })
        .collect()
}

#[cfg(test)]
mod tests;
