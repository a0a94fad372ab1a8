//! The camera that an organised cloud was seen by.
//!
//! A pixel `(u, v)` and its point `p` obey `(u, v, 1) ~ M p` with `M = K R`: a direct linear
//! transform gives `M`, its RQ decomposition `K` and `R`, and Gauss-Newton the least pixel error
//! (Hartley and Zisserman, "Multiple View Geometry in Computer Vision", 2004, sections 4.1, 4.4
//! and 6.2, with the centre of the camera at the origin).

mod error;
mod linear;
mod projection;
mod refine;

pub use error::ProjectionFitError;

use crate::camera::PinholeCamera;
use crate::cloud::Cloud;
use crate::distortion::Distortion;
use nalgebra::{Point2, UnitQuaternion, Vector3};
use projection::{Projection, Sighting};

/// What [`fit_projection`] found.
#[derive(Clone, Debug)]
pub struct ProjectionFit {
    /// Pinhole camera of the size of the grid, without distortion.
    pub camera: PinholeCamera,
    /// Rotation from the frame of the cloud to the optical frame.
    pub camera_from_cloud: UnitQuaternion<f64>,
    /// Root mean square distance between projected points and their pixels, outliers (farther than
    /// 3 pixels, at most 5 % of the points) left out; pixels.
    pub residual_px: f64,
}

/// Fewest valid points.
const MIN_POINTS: usize = 100;
/// Most points looked at, spread evenly over the valid ones.
const MAX_POINTS: usize = 20_000;
/// A point is an outlier beyond this, pixels.
const OUTLIER_PX: f64 = 3.0;
/// Largest share of outliers.
const MAX_OUTLIER_SHARE: f64 = 0.05;
/// Largest root mean square error of the others, pixels.
const MAX_RESIDUAL_PX: f64 = 1.0;

/// Finds the intrinsics, and the rotation to the optical frame, of the camera that saw `cloud`.
///
/// `cloud` is organised in metres, with its origin at the centre of the camera and its axes turned
/// in any way.
///
/// # Errors
///
/// A cloud that is not organised, has fewer than 100 valid points, is mirrored, or was not seen by
/// a pinhole camera from its origin (an rms error over 1 pixel, or over 5 % of outliers).
pub fn fit_projection(cloud: &Cloud) -> Result<ProjectionFit, ProjectionFitError> {
    let (width, height) = cloud.grid().ok_or(ProjectionFitError::NoGrid)?;
    let sightings = sample(cloud, width)?;
    let start = linear::fit(&sightings)?;
    let projection = refine::refine(&sightings, start)?;
    let residual_px = residual(&sightings, &projection)?;
    let Projection { fx, fy, cx, cy, rotation } = projection;
    let camera = PinholeCamera::new(width, height, fx, fy, cx, cy, Distortion::None)?;
    Ok(ProjectionFit { camera, camera_from_cloud: rotation, residual_px })
}

/// At most [`MAX_POINTS`] of the valid points, evenly spread.
fn sample(cloud: &Cloud, width: u32) -> Result<Vec<Sighting>, ProjectionFitError> {
    let seen: Vec<_> =
        cloud.valid_indexed().filter(|(_, p)| p.coords != Vector3::zeros()).collect();
    if seen.len() < MIN_POINTS {
        let (valid, required) = (seen.len(), MIN_POINTS);
        return Err(ProjectionFitError::TooFewPoints { valid, required });
    }
    let count = seen.len().min(MAX_POINTS);
    let sighting = |i: usize| {
        let (index, point) = seen.get(i * seen.len() / count)?;
        let (u, v) = (index % width as usize, index / width as usize);
        let direction = point.coords.cast::<f64>().normalize();
        Some(Sighting { pixel: Point2::new(u as f64, v as f64), direction })
    };
    Ok((0..count).filter_map(sighting).collect())
}

/// Root mean square error of the inliers, if that and the number of outliers make a pinhole.
fn residual(sightings: &[Sighting], projection: &Projection) -> Result<f64, ProjectionFitError> {
    let errors: Vec<f64> = sightings.iter().map(|s| projection.error_px(s)).collect();
    let inliers: Vec<f64> = errors.iter().copied().filter(|e| *e <= OUTLIER_PX).collect();
    let (points, outliers) = (errors.len(), errors.len() - inliers.len());
    let residual_px =
        (inliers.iter().map(|e| e * e).sum::<f64>() / inliers.len().max(1) as f64).sqrt();
    let few_outliers = outliers as f64 <= MAX_OUTLIER_SHARE * points as f64;
    if few_outliers && residual_px <= MAX_RESIDUAL_PX {
        Ok(residual_px)
    } else {
        Err(ProjectionFitError::NotAPinhole { residual_px, outliers, points })
    }
}
