//! How far off an answer by a marker is expected to be.
//!
//! As in ARCHITECTURE.md, (11): the scatter of what is left over, what changes when views are left out, and
//! what is wrong in every picture alike, which neither of these can see: the camera's stated intrinsics.

use super::arrangement::Arrangement;
use crate::calibrate::Deviation;
use eyebolt_geometry::{Camera, CoordinateFrame, PinholeCamera, Tangent, Transform};
use eyebolt_markers::hand_eye::{Refined, View, refine};
use nalgebra::{Matrix3, Matrix6, Point3, SMatrix};

/// What adds to an expected error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkerErrorPart {
    /// `scatter`, `left_out` or `intrinsics`.
    pub source: &'static str,
    /// Root mean square error from it alone.
    pub expected: Deviation,
}

/// How far off an answer is expected to be.
#[derive(Clone, Debug, PartialEq)]
pub struct MarkerErrorEstimate {
    /// Root mean square error of all sources together, in the middle of where the marker was.
    pub expected: Deviation,
    /// The same of the camera's own position, metres.
    pub camera_position_m: f64,
    /// What each source adds; parts add up in squares.
    pub parts: Vec<MarkerErrorPart>,
    /// Covariance of the answer in the depth optical frame, as [`Transform::retract`] has it.
    pub covariance: Matrix6<f64>,
    /// What each part of the views changes when it is left out; `None` with too few views.
    pub leave_one_out: Option<Vec<Deviation>>,
    /// Where errors are measured, in the frame of what the camera stands on: the middle of where the marker
    /// was.
    pub workspace_in_root: Point3<f64>,
}

/// Stated focal lengths are off by this share, and principal points by so many pixels: what factories
/// promise, and warmth changes.
const FOCAL_SIGMA: f64 = 0.002;
const CENTRE_SIGMA_PX: f64 = 1.0;

/// Estimates the error of `refined`, which is of the colour camera.
pub(super) fn estimate<A: Arrangement>(
    refined: &Refined<A::Root, A::Carrier>,
    views: &[View<A::Root, A::Carrier>],
    camera: &PinholeCamera,
    depth_from_color: &Transform<Camera, Camera>,
) -> MarkerErrorEstimate {
    let answer = refined.hand_eye;
    let pose = answer.camera_from_root;
    let workspace_in_root = workspace::<A>(refined, views);
    let mut sources = vec![("scatter", refined.covariance)];
    if let Some(left_out) = &refined.left_out {
        sources.push(("left_out", left_out.covariance));
    }
    sources.push(("intrinsics", by_intrinsics::<A>(refined, views, camera)));
    let covariance: Matrix6<f64> = sources.iter().map(|(_, covariance)| covariance).sum();
    let at = |covariance: &Matrix6<f64>| expected(covariance, &pose, &workspace_in_root);
    let parts = sources
        .iter()
        .map(|(source, covariance)| MarkerErrorPart { source, expected: at(covariance) });
    let between = |other: &Transform<Camera, A::Root>| Deviation {
        translation_m: (pose.point(&workspace_in_root) - other.point(&workspace_in_root)).norm(),
        rotation_rad: pose.rotation().angle_to(&other.rotation()),
    };
    let turn = depth_from_color.rotation().to_rotation_matrix().into_inner();
    let mut both = Matrix6::zeros();
    both.fixed_view_mut::<3, 3>(0, 0).copy_from(&turn);
    both.fixed_view_mut::<3, 3>(3, 3).copy_from(&turn);
    let camera_in_root = Point3::from(pose.inverse().translation_m());
    MarkerErrorEstimate {
        expected: at(&covariance),
        camera_position_m: expected(&covariance, &pose, &camera_in_root).translation_m,
        parts: parts.collect(),
        covariance: both * covariance * both.transpose(),
        leave_one_out: refined
            .left_out
            .as_ref()
            .map(|l| l.answers.iter().map(|a| between(&a.camera_from_root)).collect()),
        workspace_in_root,
    }
}

/// Middle of where the marker was, in the frame of what the camera stands on.
fn workspace<A: Arrangement>(
    refined: &Refined<A::Root, A::Carrier>,
    views: &[View<A::Root, A::Carrier>],
) -> Point3<f64> {
    let marker = Point3::from(refined.hand_eye.carrier_from_marker.translation_m());
    let places = views.iter().map(|view| view.root_from_carrier.point(&marker).coords);
    Point3::from(places.sum::<nalgebra::Vector3<f64>>() / views.len().max(1) as f64)
}

/// Covariance from intrinsics that are as far off as they usually are: the answer is found anew with each.
fn by_intrinsics<A: Arrangement>(
    refined: &Refined<A::Root, A::Carrier>,
    views: &[View<A::Root, A::Carrier>],
    camera: &PinholeCamera,
) -> Matrix6<f64> {
    let answer = &refined.hand_eye;
    let off = [(FOCAL_SIGMA, 0.0, 0.0), (0.0, CENTRE_SIGMA_PX, 0.0), (0.0, 0.0, CENTRE_SIGMA_PX)];
    let shift = |(focal, cx, cy): (f64, f64, f64)| -> Option<Tangent> {
        let other = PinholeCamera::new(
            camera.width(),
            camera.height(),
            camera.fx() * (1.0 + focal),
            camera.fy() * (1.0 + focal),
            camera.cx() + cx,
            camera.cy() + cy,
            *camera.distortion(),
        );
        let found = refine(views, &other.ok()?, answer)?;
        Some(answer.camera_from_root.local(&found.hand_eye.camera_from_root))
    };
    off.into_iter().filter_map(shift).map(|shift| shift * shift.transpose()).sum()
}

/// Root mean square of the errors that `covariance` lets one expect at a point of the root's frame.
fn expected<Root: CoordinateFrame>(
    covariance: &Matrix6<f64>,
    pose: &Transform<Camera, Root>,
    at_in_root: &Point3<f64>,
) -> Deviation {
    let arm = pose.direction(&at_in_root.coords);
    let mut by_pose = SMatrix::<f64, 3, 6>::zeros();
    by_pose.fixed_view_mut::<3, 3>(0, 0).copy_from(&Matrix3::identity());
    by_pose.fixed_view_mut::<3, 3>(0, 3).copy_from(&-arm.cross_matrix());
    let point = by_pose * covariance * by_pose.transpose();
    let rotation = covariance.fixed_view::<3, 3>(3, 3).trace();
    Deviation { translation_m: point.trace().sqrt(), rotation_rad: rotation.sqrt() }
}
