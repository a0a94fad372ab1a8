//! One rigid shape fitted to the points that were seen of it.

mod kd_tree;
mod point_to_point;

pub use kd_tree::KdTree;
pub use point_to_point::{PointToPoint, PointToPointOptions, point_to_point};

use crate::arm::{ArmModel, Posture};
use crate::evidence::moved_by_base;
use crate::normal_equations::NormalEquations;
use crate::refine::StopReason;
use crate::robust::{geman_mcclure, median};
use eyebolt_geometry::{Base, Camera, Transform};
use nalgebra::{Matrix6, Point3, UnitQuaternion, Vector6};
use std::collections::BTreeMap;

/// How a shape is fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IcpOptions {
    /// Distance at which a point has a quarter of its say at first, metres: as far as the start may be off.
    pub first_scale_m: f64,
    /// The same in the end, unless the points are noisier, metres.
    pub least_scale_m: f64,
    /// Steps at most.
    pub most_steps: usize,
}

impl Default for IcpOptions {
    /// From a start that is off by some centimetres and ten degrees or so.
    fn default() -> Self {
        Self { first_scale_m: 0.03, least_scale_m: 0.002, most_steps: 30 }
    }
}

/// What a fit comes to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Icp {
    /// Pose of the shape.
    pub camera_from_base: Transform<Camera, Base>,
    /// Standard deviation of the points from the surface, robustly, metres.
    pub deviation_m: f64,
    /// Share of the points within three of these deviations, on a side of the shape that the camera can see.
    pub inliers: f64,
    /// Sum of `w J^T J`, 1 for a point on its place: of the shape's translation, then of its turn about its
    /// origin, both in the camera's axes. Divided by the square of the deviation, the information if points were
    /// independent.
    pub information: Matrix6<f64>,
    /// Steps taken.
    pub steps: usize,
    /// Why no more.
    pub stop: StopReason,
}

/// Steps shorter than this are negligible, metres and radians: points at the edge of being seen come and go.
const NEGLIGIBLE: f64 = 5e-5;
/// By which the scale falls from step to step.
const FALL: f64 = 0.6;
/// Points farther away than so many scales have no say that matters.
const REACH: f64 = 4.0;

/// Fits the shape of `arm` in `posture`, which does not bend, to `points` seen of it, camera frame, metres.
///
/// Point to surface: the residual is the signed distance of a point by the links' fields, so that no point has to
/// be paired with another, and its gradient the normal (cf. Fitzgibbon, *Robust registration of 2D and 3D point
/// sets*, IVC 2003). Geman-McClure weights, whose scale falls from step to step to that of the noise (graduated
/// non-convexity). Points whose nearest surface faces away were seen of something else.
pub fn icp(
    arm: &ArmModel,
    posture: &Posture,
    points: &[Point3<f32>],
    start: &Transform<Camera, Base>,
    options: &IcpOptions,
) -> Icp {
    let mut found = Icp {
        camera_from_base: *start,
        deviation_m: f64::INFINITY,
        inliers: 0.0,
        information: Matrix6::zeros(),
        steps: 0,
        stop: StopReason::IterationLimit,
    };
    let (mut scale_m, mut settled) = (options.first_scale_m, false);
    let mut sizes = Vec::with_capacity(points.len());
    while found.steps < options.most_steps {
        let sum = gather(arm, posture, points, &found.camera_from_base, scale_m, &mut sizes);
        let (Some(typical), Some(step)) = (median(&mut sizes), sum.solve(1e-9)) else {
            found.stop = StopReason::Underdetermined;
            return found;
        };
        found.steps += 1;
        found.information = sum.information;
        found.camera_from_base = moved(&found.camera_from_base, &step);
        found.deviation_m = 1.4826 * typical;
        // Once it is that of the noise, the scale stays: it would tremble with each point that comes and goes.
        if !settled {
            let floor_m = options.least_scale_m.max(2.0 * found.deviation_m).min(scale_m);
            settled = floor_m > 0.95 * scale_m;
            scale_m = floor_m.max(FALL * scale_m);
        }
        if settled && step.amax() < NEGLIGIBLE {
            found.stop = StopReason::Converged;
            break;
        }
    }
    let within = 3.0 * found.deviation_m.max(0.5 * options.least_scale_m);
    gather(arm, posture, points, &found.camera_from_base, within / REACH, &mut sizes);
    found.inliers = sizes.len() as f64 / points.len().max(1) as f64;
    found
}

/// Which points err together: of each point, the number of its cluster.
#[derive(Clone, Copy, Debug)]
pub enum Errors<'a> {
    /// As the residuals show: those of a cluster may err together, those of different ones do not.
    AsSeen(&'a [u32]),
    /// By this standard deviation, metres, all points of a cluster alike, whatever is left of it after the fit: a bias of a
    /// camera that a pose takes up does not show.
    Alike(&'a [u32], f64),
}

/// Covariance of what [`icp`] found, of the shape's translation and of its turn about its origin, both in the camera's axes,
/// if points err as `errors` say (sandwich; Liang and Zeger, Biometrika 1986). `None` where the points do not tell all of the
/// pose, or those of fewer than seven clusters take part, of which residuals show nothing.
pub fn clustered_covariance(
    (arm, posture): (&ArmModel, &Posture),
    points: &[Point3<f32>],
    errors: Errors<'_>,
    fit: &Icp,
    options: &IcpOptions,
) -> Option<Matrix6<f64>> {
    let scale_m = options.least_scale_m.max(2.0 * fit.deviation_m);
    let (Errors::AsSeen(cluster) | Errors::Alike(cluster, _)) = errors;
    let mut gradients: BTreeMap<u32, Vector6<f64>> = BTreeMap::new();
    let mut information = Matrix6::zeros();
    each(arm, posture, points, &fit.camera_from_base, scale_m, |at, row| {
        information += row.weight * row.jacobian * row.jacobian.transpose();
        let size_m = match errors {
            Errors::AsSeen(_) => row.residual,
            Errors::Alike(_, deviation_m) => deviation_m,
        };
        *gradients.entry(cluster[at]).or_default() += row.weight * size_m * row.jacobian;
    });
    let factor = match errors {
        Errors::Alike(..) => 1.0,
        // As many numbers are fitted.
        Errors::AsSeen(_) => {
            let spare = gradients.len().checked_sub(6).filter(|spare| *spare > 0)?;
            gradients.len() as f64 / spare as f64
        }
    };
    let scatter: Matrix6<f64> = gradients.values().map(|g| g * g.transpose()).sum();
    let inverse = information.try_inverse()?;
    Some(factor * inverse * scatter * inverse)
}

/// Normal equations at a pose, and the sizes of the residuals of the points that take part.
fn gather(
    arm: &ArmModel,
    posture: &Posture,
    points: &[Point3<f32>],
    pose: &Transform<Camera, Base>,
    scale_m: f64,
    sizes: &mut Vec<f64>,
) -> NormalEquations<6> {
    let mut sum = NormalEquations::default();
    sizes.clear();
    each(arm, posture, points, pose, scale_m, |_, Row { jacobian, residual, weight }| {
        sum.add_lower(&jacobian, residual, weight, weight);
        sizes.push(residual.abs());
    });
    sum.mirror();
    sum
}

/// What a point says of the pose.
struct Row {
    jacobian: Vector6<f64>,
    residual: f64,
    weight: f64,
}

/// Hands on what each of the points that take part says.
fn each(
    arm: &ArmModel,
    posture: &Posture,
    points: &[Point3<f32>],
    pose: &Transform<Camera, Base>,
    scale_m: f64,
    mut take: impl FnMut(usize, Row),
) {
    let limit_m = (REACH * scale_m) as f32;
    let inverse = pose.inverse().isometry().cast::<f32>();
    let turn = pose.rotation().to_rotation_matrix();
    let origin = pose.translation_m();
    let mut last = 0;
    for (at, point) in points.iter().enumerate() {
        let in_base = inverse * point;
        let Some(nearest) = posture.nearest_within(arm, &in_base, limit_m, last) else { continue };
        last = nearest.link;
        let normal = turn * nearest.gradient_in_base.cast::<f64>();
        let seen = point.coords.cast::<f64>();
        let residual = f64::from(nearest.distance_m);
        if normal.dot(&seen) > 0.0 || residual < -f64::from(limit_m) {
            continue;
        }
        let weight = geman_mcclure(residual, scale_m);
        // The shape moves, not the point: the sign turns.
        let jacobian = Vector6::from(moved_by_base(&-normal, &seen, &origin));
        take(at, Row { jacobian, residual, weight });
    }
}

/// The pose after a step: a translation, and a turn about the shape's origin.
fn moved(pose: &Transform<Camera, Base>, step: &Vector6<f64>) -> Transform<Camera, Base> {
    let by = step.fixed_rows::<3>(0).into_owned();
    let turn = UnitQuaternion::from_scaled_axis(step.fixed_rows::<3>(3).into_owned());
    Transform::from_parts(pose.translation_m() + by, turn * pose.rotation())
}
