//! Gauss-Newton on the pixel error, without skew.

use super::error::ProjectionFitError;
use super::projection::{Projection, Sighting};
use crate::tangent::rotation_exp;
use nalgebra::{Matrix2x3, SMatrix, SVector, Vector2, Vector3};

type Matrix7 = SMatrix<f64, 7, 7>;
type Vector7 = SVector<f64, 7>;

const MAX_STEPS: usize = 20;

/// Minimises Huber's loss of the pixel error over `fx, fy, cx, cy` and the rotation.
pub(super) fn refine(
    sightings: &[Sighting],
    start: Projection,
) -> Result<Projection, ProjectionFitError> {
    let mut projection = start;
    for _ in 0..MAX_STEPS {
        let limit = huber_limit(sightings, &projection);
        let (mut normal, mut gradient) = (Matrix7::zeros(), Vector7::zeros());
        for sighting in sightings {
            let Some((error, jacobian)) = linearise(sighting, &projection) else { continue };
            let norm = error.norm();
            let weight = if norm > limit { limit / norm } else { 1.0 };
            normal += jacobian.transpose() * jacobian * weight;
            gradient += jacobian.transpose() * error * weight;
        }
        let step = solve(normal, gradient).ok_or(ProjectionFitError::Degenerate)?;
        projection = moved(&projection, &-step);
        // Pixels for the intrinsics, and about pixels for the rotation once times the focal length.
        let turn = step.fixed_rows::<3>(4).norm() * projection.fx;
        if step.fixed_rows::<4>(0).norm() + turn < 1e-9 {
            break;
        }
    }
    Ok(projection)
}

/// 1.345 times the spread of the errors by their median, and not below rounding.
fn huber_limit(sightings: &[Sighting], projection: &Projection) -> f64 {
    let mut errors: Vec<f64> = sightings.iter().map(|s| projection.error_px(s)).collect();
    let middle = errors.len() / 2;
    let (_, median, _) = errors.select_nth_unstable_by(middle, f64::total_cmp);
    // The median length of a two-dimensional normal error is 1.1774 standard deviations.
    (1.345 * *median / 1.1774).max(1e-6)
}

/// Pixel error of a sighting in front of the camera, and its derivative by the seven parameters.
fn linearise(
    sighting: &Sighting,
    projection: &Projection,
) -> Option<(Vector2<f64>, SMatrix<f64, 2, 7>)> {
    let p = projection.rotation * sighting.direction;
    if p.z <= 1e-6 {
        return None;
    }
    let (x, y) = (p.x / p.z, p.y / p.z);
    let (fx, fy) = (projection.fx, projection.fy);
    let projected = Vector2::new(fx * x + projection.cx, fy * y + projection.cy);
    let by_point = Matrix2x3::new(fx / p.z, 0.0, -fx * x / p.z, 0.0, fy / p.z, -fy * y / p.z);
    // exp(d) p = p + d x p.
    let by_rotation = -by_point * p.cross_matrix();
    let mut jacobian = SMatrix::<f64, 2, 7>::zeros();
    jacobian.fixed_view_mut::<2, 2>(0, 0).copy_from_slice(&[x, 0.0, 0.0, y]);
    jacobian.fixed_view_mut::<2, 2>(0, 2).fill_with_identity();
    jacobian.fixed_view_mut::<2, 3>(0, 4).copy_from(&by_rotation);
    Some((projected - sighting.pixel.coords, jacobian))
}

/// Solves the normal equations with every parameter scaled to unit curvature.
fn solve(normal: Matrix7, gradient: Vector7) -> Option<Vector7> {
    let scale = normal.diagonal().map(|d| 1.0 / d.sqrt());
    if !scale.iter().all(|s| s.is_finite()) {
        return None;
    }
    let scaling = Matrix7::from_diagonal(&scale);
    let scaled = (scaling * normal * scaling).cholesky()?;
    let step = scaling * scaled.solve(&(scaling * gradient));
    step.iter().all(|s| s.is_finite()).then_some(step)
}

fn moved(projection: &Projection, step: &Vector7) -> Projection {
    let turn: Vector3<f64> = step.fixed_rows::<3>(4).into_owned();
    let mut rotation = rotation_exp(&turn) * projection.rotation;
    rotation.renormalize();
    Projection {
        fx: projection.fx + step[0],
        fy: projection.fy + step[1],
        cx: projection.cx + step[2],
        cy: projection.cy + step[3],
        rotation,
    }
}
