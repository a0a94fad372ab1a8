//! The occluding contour of what was drawn.

use crate::raster::Raster;
use eyebolt_geometry::PinholeCamera;
use nalgebra::{Point2, Point3, Vector2};
use std::ops::Range;

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
    let (columns, rows, width) = window(raster);
    let inverse = raster.inverse_depth();
    let mut points = Vec::new();
    for v in rows {
        let row = |v: usize| &inverse[v * width + columns.start..v * width + columns.end];
        let (here, above, below) = (row(v), row(v - 1), row(v + 1));
        let left = &inverse[v * width + columns.start - 1..v * width + columns.end - 1];
        let right = &inverse[v * width + columns.start + 1..v * width + columns.end + 1];
        let mut start = 0;
        // Most blocks lie on the surface or off it altogether, which is quickly told.
        for block in here.chunks(BLOCK) {
            let end = start + block.len();
            let sides = left[start..end].iter().zip(&right[start..end]);
            let rest = above[start..end].iter().zip(&below[start..end]);
            let bordering = block.iter().zip(sides).zip(rest).fold(
                false,
                |found, ((here, (left, right)), (above, below))| {
                    let empty =
                        (*left == 0.0) | (*right == 0.0) | (*above == 0.0) | (*below == 0.0);
                    found | ((*here != 0.0) & empty)
                },
            );
            if bordering {
                for u in start..end {
                    let at = v * width + columns.start + u;
                    add_cracks(raster, camera, at, |behind| behind == 0.0, &mut points);
                }
            }
            start = end;
        }
    }
    points
}

/// Pixels looked at together.
const BLOCK: usize = 16;

/// The places with an inverse depth beyond that `wanted` accepts; 0 where nothing was drawn.
fn cracks(
    raster: &Raster,
    camera: &PinholeCamera,
    wanted: impl Fn(f32) -> bool + Copy,
) -> Vec<ContourPoint> {
    let (columns, rows, width) = window(raster);
    let mut points = Vec::new();
    for v in rows {
        for u in columns.clone() {
            add_cracks(raster, camera, v * width + u, wanted, &mut points);
        }
    }
    points
}

/// Columns and rows that have a neighbourhood, and the width of the raster.
fn window(raster: &Raster) -> (Range<usize>, Range<usize>, usize) {
    let (columns, rows) = raster.drawn();
    let inner = |range: Range<usize>, limit: usize| {
        let (start, end) = (range.start.max(RADIUS), range.end.min(limit.saturating_sub(RADIUS)));
        start..end.max(start)
    };
    let (width, height) = (raster.width(), raster.height());
    let (columns, rows) = (inner(columns, width), inner(rows, height));
    // Without a column that has a neighbourhood there is no row to look at either.
    let rows = if columns.is_empty() { 0..0 } else { rows };
    (columns, rows, width)
}

/// Pixels on each side that tell where the surface is.
const RADIUS: usize = 3;

/// Adds the contour between the pixel at `at` and its neighbours.
fn add_cracks(
    raster: &Raster,
    camera: &PinholeCamera,
    at: usize,
    wanted: impl Fn(f32) -> bool,
    points: &mut Vec<ContourPoint>,
) {
    let (inverse, width) = (raster.inverse_depth(), raster.width());
    if inverse[at] == 0.0 {
        return;
    }
    let step = 1.0 / (1.0 / inverse[at] + STEP_M);
    let neighbours =
        [(1.0, 0.0, at + 1), (-1.0, 0.0, at - 1), (0.0, 1.0, at + width), (0.0, -1.0, at - width)];
    for (du, dv, beyond) in neighbours {
        let behind = inverse[beyond];
        if behind <= step && wanted(behind) {
            let crack = Vector2::new(du, dv);
            points.extend(contour_point(raster, camera, [at % width, at / width], crack, behind));
        }
    }
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
    let (inverse, step) = (raster.inverse_depth(), 1.0 / (z + STEP_M));
    let (mut right, mut down) = (0i32, 0i32);
    for row in 0..2 * RADIUS + 1 {
        let first = (v + row - RADIUS) * raster.width() + u - RADIUS;
        let (mut count, mut moment) = (0i32, 0i32);
        for (column, inverse) in inverse[first..first + 2 * RADIUS + 1].iter().enumerate() {
            let is_inside = i32::from(*inverse > step);
            count += is_inside;
            moment += is_inside * (column as i32 - RADIUS as i32);
        }
        right += moment;
        down += count * (row as i32 - RADIUS as i32);
    }
    let inside = Vector2::new(right as f32, down as f32);
    let direction = (-inside).try_normalize(1e-3)?;
    (direction.dot(&crack) > 0.1).then_some(direction)
}
