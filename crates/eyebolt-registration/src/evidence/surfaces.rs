//! Distances of what was seen from the posed arm's surfaces: ARCHITECTURE.md, (3).
//!
//! The nuisance parameter is the relative error of the depth's scale: true depth is `1 + it` times
//! the depth seen.

use super::kind::{EvidenceKind, Factor, Presentation, Reach};
use super::posed::{PosedArm, PosedView, moved_by_base};
use crate::intrinsics_offset::INTRINSICS;
use crate::unknowns::{FIRST_INTRINSIC, FIRST_NUISANCE, SURFACES, Unknowns};
use nalgebra::{Point3, Vector3};

/// Residuals in metres.
pub(crate) struct Surfaces;

impl EvidenceKind for Surfaces {
    fn presentation(&self) -> Presentation {
        Presentation {
            name: "surfaces",
            unit: "mm",
            factor: -1e3,
            positive: "seen behind the posed surface",
        }
    }

    fn first_scale(&self, reach: Reach) -> f64 {
        match reach {
            Reach::Far => 0.06,
            Reach::Near => 0.03,
            Reach::Close => 0.02,
        }
    }

    /// Shapes are simplified to half of this, and joints at rest are not stiller.
    fn least_deviation(&self) -> f64 {
        0.001
    }

    /// Depth cameras have errors that are not Gaussian, of this size, also where the noise is less.
    fn least_kernel_deviation(&self) -> f64 {
        0.002
    }

    /// Pixels over which errors of stereo and structured light are correlated: windows of about 20 by 20.
    fn correlated_samples(&self) -> f64 {
        400.0
    }

    /// Depth of cameras is long or short by one to two percent.
    fn nuisance_deviation(&self) -> f64 {
        0.02
    }

    fn needs_drawing(&self) -> bool {
        false
    }

    fn gather(&self, view: &PosedView<'_>, factors: &mut Vec<Factor>) -> f64 {
        let mut last = 0;
        for point in view.arm_points {
            let factor = surface_factor(&view.posed, point, last);
            last = factor.map_or(last, |factor| factor.link);
            factors.extend(factor);
        }
        view.pixels_per_point
    }
}

/// Distance of a point seen from the nearest surface of the posed arm.
///
/// `None` where that surface faces away: the camera cannot have seen it. `first`: the link to look
/// at first.
pub(super) fn surface_factor(
    posed: &PosedArm<'_>,
    point_in_camera: &Point3<f32>,
    first: usize,
) -> Option<Factor> {
    let PosedArm { arm, posture, state } = posed;
    let seen = point_in_camera.coords.cast::<f64>();
    let as_stated = seen * (1.0 + state.nuisances[SURFACES]);
    let point = state.intrinsics.true_point(&as_stated.into()).coords;
    let pose = state.camera_from_base.isometry();
    let point_in_base: Point3<f32> = pose.inverse_transform_point(&Point3::from(point)).cast();
    let nearest = posture.nearest_within(arm, &point_in_base, f32::INFINITY, first)?;
    let normal_in_base = nearest.gradient_in_base.cast::<f64>();
    let normal = pose.rotation * normal_in_base;
    if normal.dot(&point) > 0.0 {
        return None;
    }
    let spot = Spot { point, normal, point_in_base: point_in_base.cast(), normal_in_base };
    let jacobian = surface_jacobian(posed, nearest.link, &spot);
    Some(Factor { residual: f64::from(nearest.distance_m), jacobian, link: nearest.link })
}

/// A point of the arm's surface and its outward normal, in both frames.
pub(crate) struct Spot {
    /// Camera frame, metres; intrinsics and depth as they truly are.
    pub point: Vector3<f64>,
    pub normal: Vector3<f64>,
    pub point_in_base: Point3<f64>,
    pub normal_in_base: Vector3<f64>,
}

/// Derivative of the distance of what is seen at `spot` from the surface of `link` there.
pub(crate) fn surface_jacobian(posed: &PosedArm<'_>, link: usize, spot: &Spot) -> Unknowns {
    let Spot { point, normal, point_in_base, normal_in_base } = spot;
    let state = posed.state;
    let origin = state.camera_from_base.isometry().translation.vector;
    // The arm moves, not the point: the sign turns.
    let by_base = moved_by_base(&-normal, point, &origin);
    let mut jacobian = Unknowns::zeros();
    jacobian.fixed_rows_mut::<6>(0).copy_from_slice(&by_base);
    jacobian[FIRST_NUISANCE + SURFACES] = normal.dot(point) / (1.0 + state.nuisances[SURFACES]);
    let focal = 1.0 + state.intrinsics.focal;
    let by_intrinsics = [
        -(normal.x * point.x + normal.y * point.y) / focal,
        -normal.x * point.z / focal,
        -normal.y * point.z / focal,
    ];
    jacobian.fixed_rows_mut::<INTRINSICS>(FIRST_INTRINSIC).copy_from_slice(&by_intrinsics);
    posed.by_joints(link, &-normal_in_base, point_in_base, &mut jacobian);
    jacobian
}
