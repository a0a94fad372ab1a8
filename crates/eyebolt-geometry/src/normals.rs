//! Surface normals of an organised cloud.

use crate::cloud::Cloud;
use crate::symmetric::smallest_eigenvector;
use nalgebra::{Matrix3, Point3, Vector3};
use rayon::prelude::*;

/// Which neighbours belong to the same surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalOptions {
    /// Half the width of the window of [`normals`], pixels: 2 is a window of 5 x 5.
    pub radius_px: u32,
    /// Largest step in depth between neighbours of a surface right at the camera, metres.
    pub step_m: f32,
    /// How much that step grows with depth, metres per metre.
    pub step_per_m: f32,
    /// Share of the window that must belong to the surface of its middle, 0 to 1.
    pub min_share: f32,
}

impl Default for NormalOptions {
    fn default() -> Self {
        Self { radius_px: 2, step_m: 0.005, step_per_m: 0.01, min_share: 0.5 }
    }
}

/// Why a cloud has no normals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NormalsError {
    /// The cloud has no grid, so no point knows its neighbours.
    #[error("normals need an organised cloud")]
    NoGrid,
}

const NONE: Vector3<f32> = Vector3::new(f32::NAN, f32::NAN, f32::NAN);

/// The points of an organised cloud, addressed by signed pixel.
struct Grid<'a> {
    points: &'a [Point3<f32>],
    width: i64,
    height: i64,
    options: &'a NormalOptions,
}

/// Unit normal of every pixel toward the camera, by least squares over a window; NaN where none.
///
/// `cloud` is organised, in its optical frame. A neighbour counts if its depth differs from the
/// middle's by less than `step_m + step_per_m * z`, so a pixel beside a depth edge takes its normal
/// from its own side; with fewer than `min_share` of the window, or all on a line, it has none.
///
/// # Errors
///
/// The cloud is not organised.
pub fn normals(cloud: &Cloud, options: &NormalOptions) -> Result<Vec<Vector3<f32>>, NormalsError> {
    for_each_pixel(cloud, options, |grid, u, v| grid.plane_normal(u, v))
}

/// Unit normal of every pixel toward the camera, from its four neighbours; NaN where none.
///
/// As [`normals`], but noisier and several times faster, and none unless all four neighbours
/// belong to the surface: pixels beside a depth edge have no normal.
///
/// # Errors
///
/// The cloud is not organised.
pub fn fast_normals(
    cloud: &Cloud,
    options: &NormalOptions,
) -> Result<Vec<Vector3<f32>>, NormalsError> {
    for_each_pixel(cloud, options, |grid, u, v| grid.cross_normal(u, v))
}

fn for_each_pixel(
    cloud: &Cloud,
    options: &NormalOptions,
    normal: impl Fn(&Grid<'_>, i64, i64) -> Option<Vector3<f64>> + Sync,
) -> Result<Vec<Vector3<f32>>, NormalsError> {
    let (width, height) = cloud.grid().ok_or(NormalsError::NoGrid)?;
    let (width, height) = (i64::from(width), i64::from(height));
    let grid = Grid { points: cloud.points(), width, height, options };
    let (grid, normal) = (&grid, &normal);
    let pixel = |v: i64| {
        (0..width).map(move |u| match normal(grid, u, v) {
            Some(normal) => normal.cast::<f32>(),
            None => NONE,
        })
    };
    Ok((0..height).into_par_iter().flat_map_iter(pixel).collect())
}

impl Grid<'_> {
    /// The valid point of a pixel, which may lie off the grid.
    fn at(&self, u: i64, v: i64) -> Option<&Point3<f32>> {
        if !(0..self.width).contains(&u) || !(0..self.height).contains(&v) {
            return None;
        }
        let index = usize::try_from(v * self.width + u).ok()?;
        self.points.get(index).filter(|p| !p.x.is_nan())
    }

    /// The point of a pixel if it continues the surface of `middle`.
    fn neighbour(&self, middle: &Point3<f32>, u: i64, v: i64) -> Option<&Point3<f32>> {
        let step = self.options.step_m + self.options.step_per_m * middle.z;
        self.at(u, v).filter(|p| (p.z - middle.z).abs() < step)
    }

    fn cross_normal(&self, u: i64, v: i64) -> Option<Vector3<f64>> {
        let middle = self.at(u, v)?;
        let [left, right, up, down] = [(u - 1, v), (u + 1, v), (u, v - 1), (u, v + 1)]
            .map(|(u, v)| self.neighbour(middle, u, v));
        let across = (right? - left?).cast::<f64>();
        let along = (down? - up?).cast::<f64>();
        toward_camera(across.cross(&along), middle)
    }

    fn plane_normal(&self, u: i64, v: i64) -> Option<Vector3<f64>> {
        let middle = self.at(u, v)?;
        let radius = i64::from(self.options.radius_px);
        let span = |at: i64, size: i64| (at - radius).max(0)..(at + radius + 1).min(size);
        let mut sum = Vector3::<f64>::zeros();
        let mut moment = Matrix3::<f64>::zeros();
        let mut count = 0_u32;
        let pixels = span(v, self.height).flat_map(|y| span(u, self.width).map(move |x| (x, y)));
        for (x, y) in pixels {
            // Relative to the middle, so that nothing cancels.
            if let Some(point) = self.neighbour(middle, x, y) {
                let offset = (point - middle).cast::<f64>();
                sum += offset;
                moment += offset * offset.transpose();
                count += 1;
            }
        }
        let window = (2.0 * radius as f64 + 1.0).powi(2);
        if count < 3 || f64::from(count) < f64::from(self.options.min_share) * window {
            return None;
        }
        let covariance = moment - sum * sum.transpose() / f64::from(count);
        toward_camera(smallest_eigenvector(&covariance)?, middle)
    }
}

/// `direction` with length 1 and pointing from `point` to the origin's side.
fn toward_camera(direction: Vector3<f64>, point: &Point3<f32>) -> Option<Vector3<f64>> {
    let normal = direction.try_normalize(0.0)?;
    let away = normal.dot(&point.coords.cast::<f64>()) > 0.0;
    Some(if away { -normal } else { normal })
}
