//! The occluding contour of what was drawn.

use crate::raster::Raster;
use eyebolt_geometry::PinholeCamera;
use nalgebra::{Point2, Point3, Vector2};

/// A place where the surface ends in the image and something behind it begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContourPoint {
    /// Middle between the last pixel of the surface and the first beyond.
    pub pixel: Point2<f32>,
    /// The point of the surface there, camera frame, metres.
    pub point_in_camera: Point3<f32>,
    /// Unit vector in the image, out of the surface.
    pub outward: Vector2<f32>,
    /// The link that the surface belongs to.
    pub link: u8,
    /// Depth of what is seen right beyond, metres, if it is part of the drawing too.
    pub behind_m: Option<f32>,
}

/// Two pixels of one drawing whose depths differ by more than this do not belong together, metres.
const STEP_M: f32 = 0.03;

/// All places where a drawn pixel borders on an empty or much farther one, row by row.
///
/// Pixels at the border of the image are no contour: the surface may go on beyond it.
pub fn contour(raster: &Raster, camera: &PinholeCamera) -> Vec<ContourPoint> {
    cracks(raster, camera, |_| true)
}

/// The part of [`contour`] beyond which nothing was drawn.
pub fn outer_contour(raster: &Raster, camera: &PinholeCamera) -> Vec<ContourPoint> {
    cracks(raster, camera, |behind| behind == 0.0)
}

/// The places with an inverse depth beyond that `wanted` accepts; 0 where nothing was drawn.
fn cracks(
    raster: &Raster,
    camera: &PinholeCamera,
    wanted: impl Fn(f32) -> bool,
) -> Vec<ContourPoint> {
    let (columns, rows) = raster.drawn();
    let width = raster.width();
    let inverse = raster.inverse_depth();
    let mut points = Vec::new();
    for v in rows.start.max(3)..rows.end.min(raster.height().saturating_sub(3)) {
        for u in columns.start.max(3)..columns.end.min(width.saturating_sub(3)) {
            let at = v * width + u;
            if inverse[at] == 0.0 {
                continue;
            }
            let z = 1.0 / inverse[at];
            let step = 1.0 / (z + STEP_M);
            let neighbours = [
                (1.0, 0.0, at + 1),
                (-1.0, 0.0, at - 1),
                (0.0, 1.0, at + width),
                (0.0, -1.0, at - width),
            ];
            for (du, dv, beyond) in neighbours {
                let behind = inverse[beyond];
                if behind <= step && wanted(behind) {
                    let crack = Vector2::new(du, dv);
                    points.extend(contour_point(raster, camera, [u, v], crack, behind));
                }
            }
        }
    }
    points
}

/// The contour between pixel `[u, v]` and its neighbour in the direction `crack`.
fn contour_point(
    raster: &Raster,
    camera: &PinholeCamera,
    [u, v]: [usize; 2],
    crack: Vector2<f32>,
    behind: f32,
) -> Option<ContourPoint> {
    let at = v * raster.width() + u;
    let (z, link) = (raster.depth_m(at)?, raster.link(at)?);
    let pixel = Point2::new(u as f32, v as f32) + 0.5 * crack;
    let outward = outward(raster, u, v, z, crack)?;
    let ray = camera.ray(&pixel.cast::<f64>())?;
    let point_in_camera = Point3::from(ray.cast::<f32>() * z);
    let behind_m = (behind > 0.0).then(|| 1.0 / behind);
    Some(ContourPoint { pixel, point_in_camera, outward, link, behind_m })
}

/// Direction out of the surface: away from where its pixels are in the neighbourhood.
fn outward(
    raster: &Raster,
    u: usize,
    v: usize,
    z: f32,
    crack: Vector2<f32>,
) -> Option<Vector2<f32>> {
    let mut inside = Vector2::zeros();
    let (inverse, step) = (raster.inverse_depth(), 1.0 / (z + STEP_M));
    for dv in -3i32..=3 {
        for du in -3i32..=3 {
            let at = (v as i32 + dv) as usize * raster.width() + (u as i32 + du) as usize;
            if inverse[at] > step {
                inside += Vector2::new(du as f32, dv as f32);
            }
        }
    }
    let direction = (-inside).try_normalize(1e-3)?;
    (direction.dot(&crack) > 0.1).then_some(direction)
}
