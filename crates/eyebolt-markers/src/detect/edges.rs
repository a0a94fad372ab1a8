//! Corners to a fraction of a pixel: where the lines meet that fit a marker's four edges.

use crate::grey::GreyImage;
use nalgebra::{Matrix2, Point2, Vector2};

/// How far to both sides of an edge its profile is read, in cells as they are seen across the edge: a cell
/// farther in, the pattern begins.
const REACH_CELLS: f64 = 0.7;
/// The least and the most of that, pixels.
const REACH_PX: (f64, f64) = (1.5, 4.0);
/// Step along a profile, pixels.
const STEP_PX: f64 = 0.5;
/// Profiles of one edge.
const PROFILES: (f64, f64) = (6.0, 60.0);
/// A point of an edge that is farther from the line than this is something else's, pixels.
const OUTLIER_PX: f64 = 0.7;
/// Each time the profiles are read about the lines that were found before.
const ROUNDS: usize = 4;
/// Corners that are farther than this from where the outline has them are somebody else's, pixels.
const FARTHEST_PX: f64 = 3.0;

/// A line through `point` along the unit vector `along`.
struct Line {
    point: Point2<f64>,
    along: Vector2<f64>,
}

/// The corners of a marker of `cells` cells in a row that has about these `corners`, clockwise as a
/// picture shows it; `None` if an edge is not seen.
pub(super) fn refined(
    image: &GreyImage,
    corners: &[Point2<f64>; 4],
    cells: usize,
) -> Option<[Point2<f64>; 4]> {
    let mut now = *corners;
    for _ in 0..ROUNDS {
        let row_area = area(&now) / cells as f64;
        let side = |i: usize| edge(image, now[i], now[(i + 1) % 4], cells, row_area);
        let lines = [side(0)?, side(1)?, side(2)?, side(3)?];
        let corner = |i: usize| meeting(&lines[(i + 3) % 4], &lines[i]);
        now = [corner(0)?, corner(1)?, corner(2)?, corner(3)?];
        let near = now.iter().zip(corners).all(|(a, b)| (a - b).norm() <= FARTHEST_PX);
        if !near {
            return None;
        }
    }
    Some(now)
}

/// Area of a quadrilateral, square pixels.
fn area(corners: &[Point2<f64>; 4]) -> f64 {
    let [a, b, c, d] = corners;
    0.5 * (c - a).perp(&(d - b)).abs()
}

/// The line along the edge between `from` and `to`, dark on its right, of a marker whose rows of cells have that
/// area.
fn edge(
    image: &GreyImage,
    from: Point2<f64>,
    to: Point2<f64>,
    cells: usize,
    row_area: f64,
) -> Option<Line> {
    let length = (to - from).norm();
    let along = (to - from) / length;
    let outward = Vector2::new(along.y, -along.x);
    let reach = (REACH_CELLS * row_area / length).clamp(REACH_PX.0, REACH_PX.1);
    // Near its ends, an edge is bent by the blur of the next.
    let clear = (0.5 * length / cells as f64).max(1.5).min(0.25 * length);
    let count = (length - 2.0 * clear).clamp(PROFILES.0, PROFILES.1).round();
    let mut points = Vec::with_capacity(count as usize);
    for i in 0..count as usize {
        let place = clear + (length - 2.0 * clear) * (i as f64 + 0.5) / count;
        let middle = from + along * place;
        if let Some((offset, strength)) = profile(image, middle, outward, reach) {
            points.push((place, offset, strength));
        }
    }
    if (points.len() as f64) < 0.5 * count {
        return None;
    }
    let (offset, slope) = fitted(&points)?;
    Some(Line {
        point: from + outward * offset,
        along: (along + outward * slope).try_normalize(0.0)?,
    })
}

/// Where along `outward` from `middle` it gets light, and how much: the centre of the slope.
fn profile(
    image: &GreyImage,
    middle: Point2<f64>,
    outward: Vector2<f64>,
    reach: f64,
) -> Option<(f64, f64)> {
    let steps = (reach / STEP_PX).round() as i32;
    let at = |k: f64| {
        let place = middle + outward * (k * STEP_PX);
        image.sample(place.x, place.y)
    };
    let (mut sum, mut moment) = (0.0, 0.0);
    let mut before = at(-f64::from(steps) - 0.5)?;
    for k in -steps..=steps {
        let after = at(f64::from(k) + 0.5)?;
        let rise = (after - before).max(0.0);
        sum += rise;
        moment += rise * f64::from(k) * STEP_PX;
        before = after;
    }
    (sum > 5.0).then(|| (moment / sum, sum))
}

/// Offset and slope of the line through points of place, offset and weight, without those that are far
/// from it.
fn fitted(points: &[(f64, f64, f64)]) -> Option<(f64, f64)> {
    let (mut offset, mut slope) = (0.0, 0.0);
    for round in 0..4 {
        let mut normal = Matrix2::zeros();
        let mut right = Vector2::zeros();
        for (place, value, weight) in points {
            let off = value - offset - slope * place;
            // Geman and McClure's, once there is a line to be far from.
            let trust = if round == 0 { 1.0 } else { (1.0 + (off / OUTLIER_PX).powi(2)).powi(-2) };
            let row = Vector2::new(1.0, *place);
            normal += row * row.transpose() * (weight * trust);
            right += row * (value * weight * trust);
        }
        let solved = normal.try_inverse()? * right;
        (offset, slope) = (solved.x, solved.y);
    }
    (offset.is_finite() && slope.is_finite()).then_some((offset, slope))
}

fn meeting(a: &Line, b: &Line) -> Option<Point2<f64>> {
    let sides = Matrix2::from_columns(&[a.along, -b.along]);
    let along = sides.try_inverse()? * (b.point - a.point);
    Some(a.point + a.along * along.x)
}
