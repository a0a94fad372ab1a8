//! The two kinds of evidence that a pose is fitted to.
//!
//! Unknowns: translation (m) and rotation vector (rad) of `camera_from_base` as
//! [`Transform::retract`](eyebolt_geometry::Transform::retract) has them, the relative error of the
//! depth's scale, and the width in pixels by which the outline seen is too wide.

use crate::arm::{ArmModel, Posture};
use crate::silhouette::Silhouette;
use eyebolt_geometry::{Base, Camera, PinholeCamera, Transform};
use eyebolt_render::ContourPoint;
use nalgebra::{Point3, SVector, Vector3};

/// Number of unknowns.
pub(crate) const UNKNOWNS: usize = 8;
/// Place of the depth scale among the unknowns.
pub(crate) const DEPTH_SCALE: usize = 6;
/// Place of the outline's excess width among the unknowns.
pub(crate) const OUTLINE_WIDTH: usize = 7;

/// A residual with its derivative by the unknowns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Factor {
    /// Metres for surfaces, pixels for outlines.
    pub residual: f64,
    pub jacobian: SVector<f64, UNKNOWNS>,
    /// The link that the evidence is about.
    pub link: usize,
}

/// What the unknowns are now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct State {
    pub camera_from_base: Transform<Camera, Base>,
    /// True depth is `1 + depth_scale` times the depth seen.
    pub depth_scale: f64,
    pub outline_px: f64,
}

impl State {
    pub fn stepped(&self, step: &SVector<f64, UNKNOWNS>) -> Self {
        Self {
            camera_from_base: self.camera_from_base.retract(&step.fixed_rows::<6>(0).into_owned()),
            depth_scale: self.depth_scale + step[DEPTH_SCALE],
            outline_px: self.outline_px + step[OUTLINE_WIDTH],
        }
    }
}

/// Derivative of `gradient . point` when the base moves the point along with itself.
fn moved_by_base(gradient: &Vector3<f64>, point: &Vector3<f64>, origin: &Vector3<f64>) -> [f64; 6] {
    let turn = (point - origin).cross(gradient);
    [gradient.x, gradient.y, gradient.z, turn.x, turn.y, turn.z]
}

/// Distance of a point seen from the nearest surface of the posed arm.
///
/// `None` where that surface faces away: the camera cannot have seen it.
pub(crate) fn surface_factor(
    arm: &ArmModel,
    posture: &Posture,
    state: &State,
    point_in_camera: &Point3<f32>,
) -> Option<Factor> {
    let seen = point_in_camera.coords.cast::<f64>();
    let point = seen * (1.0 + state.depth_scale);
    let pose = state.camera_from_base.isometry();
    let point_in_base: Point3<f32> = pose.inverse_transform_point(&Point3::from(point)).cast();
    let nearest = posture.nearest(arm, &point_in_base)?;
    let normal = pose.rotation * nearest.gradient_in_base.cast::<f64>();
    if normal.dot(&point) > 0.0 {
        return None;
    }
    // The arm moves, not the point: the sign turns.
    let by_base = moved_by_base(&-normal, &point, &pose.translation.vector);
    let mut jacobian = SVector::<f64, UNKNOWNS>::zeros();
    jacobian.fixed_rows_mut::<6>(0).copy_from_slice(&by_base);
    jacobian[DEPTH_SCALE] = normal.dot(&seen);
    Some(Factor { residual: f64::from(nearest.distance_m), jacobian, link: nearest.link })
}

/// Distance in the image of a point of the posed arm's contour from the outline seen.
///
/// `None` where no outline is known nearby, or where the nearest one is another edge.
pub(crate) fn outline_factor(
    camera: &PinholeCamera,
    silhouette: &Silhouette,
    state: &State,
    contour: &ContourPoint,
) -> Option<Factor> {
    let (distance, gradient) = silhouette.sample(&contour.pixel)?;
    if gradient.dot(&contour.outward) < 0.5 {
        return None;
    }
    let point = contour.point_in_camera.cast::<f64>();
    let (_, by_point) = camera.project_with_jacobian(&point)?;
    let along = by_point.tr_mul(&gradient.cast::<f64>());
    let origin = state.camera_from_base.translation_m();
    let mut jacobian = SVector::<f64, UNKNOWNS>::zeros();
    jacobian.fixed_rows_mut::<6>(0).copy_from_slice(&moved_by_base(&along, &point.coords, &origin));
    jacobian[OUTLINE_WIDTH] = 1.0;
    let residual = f64::from(distance) + state.outline_px;
    Some(Factor { residual, jacobian, link: contour.link as usize })
}
