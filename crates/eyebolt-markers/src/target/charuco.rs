//! Corners of a ChArUco board's squares: where four of them meet, the picture has a saddle.

use crate::detect::Detection;
use crate::grey::GreyImage;
use crate::homography::Homography;
use crate::sighting::Correspondence;
use nalgebra::{Matrix2, Point2, Point3, Vector2};

/// The window about a corner is smaller than the way to the next tag's border, and not larger than this,
/// pixels.
const LARGEST_WINDOW_PX: f64 = 6.0;
const SMALLEST_WINDOW_PX: f64 = 1.5;
const ROUNDS: usize = 30;
const SETTLED_PX: f64 = 1e-4;

/// Column and row of the white square with the tag of that number.
pub(super) fn square(number: u32, columns: u32) -> (u32, u32) {
    // Two rows have one tag in each column: in even rows they stand in odd columns.
    let (pair, rest) = (number / columns, number % columns);
    let upper = columns / 2;
    if rest < upper { (2 * rest + 1, 2 * pair) } else { (2 * (rest - upper), 2 * pair + 1) }
}

/// A board as this file needs it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Board {
    pub columns: u32,
    pub rows: u32,
    pub square_m: f64,
    pub marker_m: f64,
    pub first_id: u32,
}

/// The inner corners of `board` next to the markers that were found in `image`.
pub(super) fn corners(
    image: &GreyImage,
    board: &Board,
    found: &[(&Detection, [Point3<f64>; 4])],
) -> Vec<Correspondence> {
    let maps: Vec<_> = found
        .iter()
        .filter_map(|(marker, corners)| {
            let pairs: Vec<_> = corners.iter().map(|c| c.xy()).zip(marker.corners_px).collect();
            Some((square(marker.id - board.first_id, board.columns), Homography::fit(&pairs)?))
        })
        .collect();
    let mut all = Vec::new();
    for row in 1..board.rows {
        for column in 1..board.columns {
            let at = Point2::new(f64::from(column), f64::from(row)) * board.square_m;
            // The two white squares that touch the corner.
            let next = maps.iter().filter(|((c, r), _)| {
                (*c == column || *c + 1 == column) && (*r == row || *r + 1 == row)
            });
            let seen: Vec<Point2<f64>> = next.clone().map(|(_, map)| map.map(&at)).collect();
            if seen.is_empty() {
                continue;
            }
            let start = Point2::from(
                seen.iter().map(|p| p.coords).sum::<Vector2<f64>>() / seen.len() as f64,
            );
            let clear = 0.5 * (board.square_m - board.marker_m);
            let pixels_per_metre =
                next.map(|(_, map)| density(map, &at)).fold(f64::INFINITY, f64::min);
            let window = (0.8 * clear * pixels_per_metre).min(LARGEST_WINDOW_PX);
            let pixel = saddle(image, start, window.max(SMALLEST_WINDOW_PX));
            all.extend(pixel.map(|pixel| Correspondence {
                point_in_marker: Point3::new(at.x, at.y, 0.0),
                pixel,
            }));
        }
    }
    all
}

/// Pixels to the metre around a point of the board, in the direction where they are fewest.
fn density(map: &Homography, at: &Point2<f64>) -> f64 {
    let step = 1e-4;
    let along = |d: Vector2<f64>| (map.map(&(at + d * step)) - map.map(at)).norm() / step;
    along(Vector2::x()).min(along(Vector2::y()))
}

/// The saddle near `start`: the point from which every gradient in the window is square to the way to it
/// (Förstner and Gülch 1987). `None` if it is not within the window, or there is none.
fn saddle(image: &GreyImage, start: Point2<f64>, window_px: f64) -> Option<Point2<f64>> {
    let reach = window_px.ceil() as i32;
    let mut at = start;
    for _ in 0..ROUNDS {
        let (mut normal, mut right) = (Matrix2::zeros(), Vector2::zeros());
        for v in -reach..=reach {
            for u in -reach..=reach {
                let offset = Vector2::new(f64::from(u), f64::from(v));
                let weight = (-offset.norm_squared() / (window_px * window_px)).exp();
                let place = at + offset;
                let value = |du: f64, dv: f64| image.sample(place.x + du, place.y + dv);
                let gradient = Vector2::new(
                    value(1.0, 0.0)? - value(-1.0, 0.0)?,
                    value(0.0, 1.0)? - value(0.0, -1.0)?,
                );
                let square = gradient * gradient.transpose() * weight;
                normal += square;
                right += square * offset;
            }
        }
        let step = normal.try_inverse()? * right;
        at += step;
        let moved_px = (at - start).norm();
        if moved_px > window_px || moved_px.is_nan() {
            return None;
        }
        if step.norm() < SETTLED_PX {
            return Some(at);
        }
    }
    None
}
