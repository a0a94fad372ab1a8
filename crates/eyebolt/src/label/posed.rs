//! The arm as what lies near the posed model.

use super::labeller::{Labeller, Labelling};
use crate::observations::{Configuration, Observations};
use eyebolt_geometry::{Base, Camera, RayTable, Transform};
use eyebolt_registration::{ArmModel, Label, Labels, Margin, Start, View};
use eyebolt_render::Raster;
use nalgebra::Point3;
use rayon::prelude::*;
use std::error::Error;
use std::ops::Range;

/// Pixels around the drawn arm that are labelled too: as far as an outline is searched.
const BORDER_PX: usize = 30;
/// A mask's own edge is trusted this closely, pixels.
const MASK_EDGE_PX: f32 = 6.0;
/// Pixels this far inside the outline show the arm's surface undisturbed by its edge.
const INTERIOR_PX: f32 = 4.0;

/// Labels what lies near the arm posed as `at` has it, end-effector and rest told apart.
#[derive(Clone, Copy, Debug)]
pub struct PosedModel {
    /// The pose, and how far off the joints are.
    pub at: Start,
}

impl Labeller for PosedModel {
    fn label(
        &self,
        observations: &Observations,
    ) -> Result<Labelling, Box<dyn Error + Send + Sync>> {
        let one = |configuration: &Configuration| {
            let (arm, rays) = (&observations.arm, &observations.rays);
            let posture = configuration.posture.moved(arm, &self.at.joint_offsets);
            let view = View {
                posture: &posture,
                depth_factor: self.at.depth_factor(),
                ..observations.view(configuration)
            };
            let pose = &self.at.camera_from_base;
            let labels = labels_at(arm, &view, rays, &mut Raster::new(view.camera), pose);
            with_end_effector(labels, arm, &view, rays, pose)
        };
        let labels = observations.configurations.par_iter().map(one).collect();
        Ok(Labelling { labels, whole_arm: true })
    }
}

/// `labels` with those pixels of the arm that are nearest to a link of the end-effector told apart.
fn with_end_effector(
    labels: Labels,
    arm: &ArmModel,
    view: &View<'_>,
    rays: &RayTable,
    camera_from_base: &Transform<Camera, Base>,
) -> Labels {
    let base_from_camera = camera_from_base.inverse().isometry().cast::<f32>();
    let width = view.depth.width() as usize;
    let mut last = 0;
    labels.mapped(|u, v, label| {
        let z = view.depth_m(v * width + u);
        if label != Label::Arm || z <= 0.0 {
            return label;
        }
        let point = base_from_camera * rays.point(v * width + u, z);
        let limit_m = Margin::Beside.at_m(z);
        let Some(nearest) = view.posture.nearest_within(arm, &point, limit_m, last) else {
            return label;
        };
        last = nearest.link;
        if arm.is_end_effector(nearest.link) { Label::EndEffector } else { Label::Arm }
    })
}

/// Labels of the rectangle about the arm posed at `camera_from_base`.
///
/// Given a mask, its pixels are the arm, and the rest is background but for what hides the arm and
/// for what agrees with the model against the mask. Without one, pixels near the posed surface
/// are the arm; what is close to it without being of it (the table at its foot, a tool) is ignored.
/// `raster` is drawn anew.
pub fn labels_at(
    arm: &ArmModel,
    view: &View<'_>,
    rays: &RayTable,
    raster: &mut Raster,
    camera_from_base: &Transform<Camera, Base>,
) -> Labels {
    raster.draw(view.camera, &view.posture.meshes(arm, camera_from_base));
    let (columns, rows) = rectangle(view, raster);
    let distance = surface_distances(arm, view, rays, camera_from_base, &columns, &rows);
    match view.mask {
        Some(_) => with_mask(view, raster, &distance, columns, rows),
        None => without_mask(view, &distance, columns, rows),
    }
}

/// The arm as drawn and as masked, with a border.
fn rectangle(view: &View<'_>, raster: &Raster) -> (Range<usize>, Range<usize>) {
    let (mut columns, mut rows) = raster.drawn();
    if let Some(mask) = view.mask {
        let width = mask.width() as usize;
        for at in mask.as_slice().iter().enumerate().filter(|(_, set)| **set).map(|(at, _)| at) {
            let (u, v) = (at % width, at / width);
            columns = columns.start.min(u)..columns.end.max(u + 1);
            rows = rows.start.min(v)..rows.end.max(v + 1);
        }
    }
    let widen = |range: Range<usize>, limit: usize| {
        range.start.saturating_sub(BORDER_PX)..(range.end + BORDER_PX).min(limit)
    };
    (widen(columns, raster.width()), widen(rows, raster.height()))
}

/// Signed distance of what each pixel of the rectangle saw from the posed arm; NaN without depth,
/// infinite where that is not close to the arm.
fn surface_distances(
    arm: &ArmModel,
    view: &View<'_>,
    rays: &RayTable,
    camera_from_base: &Transform<Camera, Base>,
    columns: &Range<usize>,
    rows: &Range<usize>,
) -> Vec<f32> {
    let base_from_camera = camera_from_base.inverse();
    let pose = base_from_camera.isometry().cast::<f32>();
    let rotation = pose.rotation.to_rotation_matrix();
    let width = view.depth.width() as usize;
    let mut last = 0;
    let mut distances = Vec::with_capacity(columns.len() * rows.len());
    for v in rows.clone() {
        for u in columns.clone() {
            let at = v * width + u;
            let z = view.depth_m(at);
            if z <= 0.0 {
                distances.push(f32::NAN);
                continue;
            }
            let point = rotation * rays.point(at, z) + pose.translation.vector;
            let nearest = view.posture.nearest_within(arm, &point, Margin::Beside.at_m(z), last);
            last = nearest.map_or(last, |nearest| nearest.link);
            distances.push(nearest.map_or(f32::INFINITY, |nearest| nearest.distance_m));
        }
    }
    distances
}

fn with_mask(
    view: &View<'_>,
    raster: &Raster,
    distance: &[f32],
    columns: Range<usize>,
    rows: Range<usize>,
) -> Labels {
    let masked = |u: usize, v: usize| view.mask.is_some_and(|m| m.at(u as u32, v as u32));
    let plain = |u: usize, v: usize| if masked(u, v) { Label::Arm } else { Label::Background };
    let labels = Labels::from_fn(columns.clone(), rows.clone(), plain);
    let to_mask = labels.distance_to(Label::Arm);
    let width = columns.len();
    let (first_u, first_v) = (columns.start, rows.start);
    Labels::from_fn(columns, rows, |u, v| {
        if masked(u, v) {
            return Label::Arm;
        }
        let at = (v - first_v) * width + (u - first_u);
        let seen = view.depth_m(v * raster.width() + u);
        let model = raster.depth_m(v * raster.width() + u);
        let hidden = model.is_some_and(|z| seen > 0.0 && seen < z - Margin::Search.at_m(z));
        let disputed = to_mask[at] > MASK_EDGE_PX && distance[at] < Margin::Label.at_m(seen);
        if hidden || disputed { Label::Ignore } else { Label::Background }
    })
}

fn without_mask(
    view: &View<'_>,
    distance: &[f32],
    columns: Range<usize>,
    rows: Range<usize>,
) -> Labels {
    let width = columns.len();
    let (first_u, first_v) = (columns.start, rows.start);
    let index = |u: usize, v: usize| (v - first_v) * width + (u - first_u);
    let close = Labels::from_fn(columns.clone(), rows.clone(), |u, v| {
        let z = view.depth_m(v * view.depth.width() as usize + u);
        match distance[index(u, v)] {
            d if d < Margin::Label.at_m(z) => Label::Arm,
            d if d < Margin::Beside.at_m(z) => Label::Ignore,
            _ => Label::Background,
        }
    });
    // Pixels that mix arm and background along an edge are close too, but only a few wide: what
    // has no pixel more than two from its rim is the edge itself, not something beside the arm.
    let wide = close.opened(Label::Ignore, 2.0);
    Labels::from_fn(columns, rows, |u, v| match close.at(u, v) {
        Some(Label::Ignore) if !wide[index(u, v)] => Label::Background,
        Some(label) => label,
        None => Label::Background,
    })
}

/// Points seen on the arm clear of its outline, about `wanted` of them on a regular grid of
/// pixels, camera frame, as seen (no factor of the depth applied), and how many pixels each stands for.
pub fn arm_points(
    labels: &Labels,
    view: &View<'_>,
    rays: &RayTable,
    wanted: usize,
) -> (Vec<Point3<f32>>, f64) {
    let rim = labels.near(INTERIOR_PX, |label| !label.is_robot());
    let count = rim.iter().filter(|rim| !**rim).count();
    let stride = ((count as f64 / wanted as f64).sqrt().round() as usize).max(1);
    let (columns, rows) = (labels.columns(), labels.rows());
    let (width, image_width) = (columns.len(), view.depth.width() as usize);
    let mut points = Vec::with_capacity(count / (stride * stride) + 1);
    for v in rows.clone().step_by(stride) {
        for u in columns.clone().step_by(stride) {
            let z = view.depth.at(u as u32, v as u32);
            let clear = !rim[(v - rows.start) * width + (u - columns.start)];
            if z > 0.0 && clear {
                points.push(rays.point(v * image_width + u, z));
            }
        }
    }
    (points, (stride * stride) as f64)
}
