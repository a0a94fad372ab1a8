//! Distances in the image of the posed arm's contour from the outline seen: ARCHITECTURE.md, (4).
//!
//! The nuisance parameter is the width, in pixels, by which the outline seen is too wide.

use super::kind::{EvidenceKind, Factor, Presentation, Reach};
use super::posed::{PosedArm, PosedView, moved_by_base};
use crate::intrinsics_offset::INTRINSICS;
use crate::silhouette::Silhouette;
use crate::unknowns::{FIRST_INTRINSIC, FIRST_NUISANCE, OUTLINES, Unknowns};
use eyebolt_geometry::PinholeCamera;
use eyebolt_render::{ContourPoint, outer_contour};
use nalgebra::{Point3, Vector3};

/// Contour points looked at in a view.
const CONTOUR_POINTS: usize = 1500;

/// Residuals in pixels.
pub(crate) struct Outlines;

impl EvidenceKind for Outlines {
    fn presentation(&self) -> Presentation {
        Presentation {
            name: "outlines",
            unit: "px",
            factor: 1.0,
            positive: "the posed contour is outside the outline seen",
        }
    }

    fn first_scale(&self, reach: Reach) -> f64 {
        match reach {
            Reach::Far => 20.0,
            Reach::Near => 8.0,
            Reach::Close => 4.0,
        }
    }

    /// Labels and drawings are of whole pixels.
    fn least_deviation(&self) -> f64 {
        0.7
    }

    /// Pixels over which errors of an outline are correlated: a matching window's half.
    fn correlated_samples(&self) -> f64 {
        8.0
    }

    /// Edges of depth are off by a pixel on either side.
    fn nuisance_deviation(&self) -> f64 {
        1.0
    }

    fn needs_drawing(&self) -> bool {
        true
    }

    fn gather(&self, view: &PosedView<'_>, factors: &mut Vec<Factor>) -> f64 {
        let Some(raster) = view.raster else { return 1.0 };
        let contour = outer_contour(raster, view.camera);
        let stride = contour.len().div_ceil(CONTOUR_POINTS).max(1);
        let looked_at = contour.iter().step_by(stride);
        factors.extend(
            looked_at.filter_map(|point| {
                outline_factor(&view.posed, view.camera, view.silhouette, point)
            }),
        );
        stride as f64
    }
}

/// Distance in the image of a point of the posed arm's contour from the outline seen.
///
/// `None` where no outline is known nearby, or where the nearest one is another edge.
pub(super) fn outline_factor(
    posed: &PosedArm<'_>,
    camera: &PinholeCamera,
    silhouette: &Silhouette,
    contour: &ContourPoint,
) -> Option<Factor> {
    let point = contour.point_in_camera.cast::<f64>();
    // The arm is drawn as the stated camera sees it: the true one sees this point elsewhere.
    let to_stated = posed.state.intrinsics.stated_from_true();
    let stated = to_stated * point;
    let (there, by_stated) = camera.project_with_jacobian(&stated)?;
    let moved = there - camera.project(&point)?;
    let (distance, gradient) = silhouette.sample(&(contour.pixel + moved.cast::<f32>()))?;
    if gradient.dot(&contour.outward) < 0.5 {
        return None;
    }
    let by_stated = by_stated.tr_mul(&gradient.cast::<f64>());
    let link = contour.link as usize;
    let jacobian = outline_jacobian(posed, link, &point, &by_stated);
    let residual = f64::from(distance) + posed.state.nuisances[OUTLINES];
    Some(Factor { residual, jacobian, link })
}

/// Derivative of a distance in the image of `point` of the contour of `link`, camera frame, which has the derivative
/// `by_stated` by the point where the stated intrinsics have it.
pub(crate) fn outline_jacobian(
    posed: &PosedArm<'_>,
    link: usize,
    point: &Point3<f64>,
    by_stated: &Vector3<f64>,
) -> Unknowns {
    let along = posed.state.intrinsics.stated_from_true().tr_mul(by_stated);
    let pose = posed.state.camera_from_base.isometry();
    let origin = pose.translation.vector;
    let mut jacobian = Unknowns::zeros();
    jacobian.fixed_rows_mut::<6>(0).copy_from_slice(&moved_by_base(&along, &point.coords, &origin));
    jacobian[FIRST_NUISANCE + OUTLINES] = 1.0;
    let by_intrinsics = [
        by_stated.x * point.x + by_stated.y * point.y,
        by_stated.x * point.z,
        by_stated.y * point.z,
    ];
    jacobian.fixed_rows_mut::<INTRINSICS>(FIRST_INTRINSIC).copy_from_slice(&by_intrinsics);
    let (along, at) = (pose.inverse_transform_vector(&along), pose.inverse_transform_point(point));
    posed.by_joints(link, &along, &at, &mut jacobian);
    jacobian
}
