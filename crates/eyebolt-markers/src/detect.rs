//! Markers in pictures.

mod contours;
mod decode;
mod edges;
mod polygon;
mod threshold;

use crate::dictionary::Dictionary;
use crate::grey::GreyImage;
use nalgebra::Point2;

/// Radii of the squares whose means pixels are compared with (as OpenCV's windows of 3, 13 and 23).
const RADII: [usize; 3] = [1, 6, 11];
/// Pixels in the shortest outline that is looked at: less cannot be decoded.
const SHORTEST_OUTLINE: usize = 28;

/// A marker in a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Detection {
    /// Number of the marker in its dictionary.
    pub id: u32,
    /// Its corners, pixels: upper left, upper right, lower right, lower left of the marker as it is
    /// printed. Pixel centres are at whole numbers.
    pub corners_px: [Point2<f64>; 4],
    /// The outermost dark pixels at those corners, half a pixel within the marker's edges: what OpenCV
    /// returns without refinement.
    pub outline_px: [Point2<f64>; 4],
}

impl Detection {
    /// Length around the outline, pixels.
    fn perimeter_px(&self) -> f64 {
        let next = self.outline_px.iter().cycle().skip(1);
        self.outline_px.iter().zip(next).map(|(a, b)| (a - b).norm()).sum()
    }

    fn centre(&self) -> Point2<f64> {
        Point2::from(self.outline_px.iter().map(|c| c.coords).sum::<nalgebra::Vector2<f64>>() / 4.0)
    }
}

/// All markers of `dictionary` in `image`, by their numbers; a marker that is there twice is told twice.
///
/// Takes time in proportion to the pixels. What is too small, too flat, or cut is not found.
pub fn detect(image: &GreyImage, dictionary: &Dictionary) -> Vec<Detection> {
    let mut found: Vec<Detection> = Vec::new();
    let longest = 4 * (image.width() + image.height());
    for radius in RADII {
        let dark = threshold::darker_than_around(image, radius);
        contours::contours(dark, SHORTEST_OUTLINE, longest, |outline| {
            let corners = polygon::quadrilateral(outline);
            let marker = corners.and_then(|corners| marker(image, corners, dictionary));
            found.extend(marker);
        });
    }
    // Every threshold finds the same markers, at nearly the same place: the widest outline counts, the
    // first of equals.
    let mut distinct: Vec<Detection> = Vec::new();
    for marker in found {
        let reach = marker.perimeter_px() / 8.0;
        let same = |other: &&mut Detection| {
            other.id == marker.id && (other.centre() - marker.centre()).norm() < reach
        };
        match distinct.iter_mut().find(same) {
            Some(other) if other.perimeter_px() < marker.perimeter_px() => *other = marker,
            Some(_) => {}
            None => distinct.push(marker),
        }
    }
    for marker in &mut distinct {
        let edges = edges::refined(image, &marker.corners_px, dictionary.side() + 2);
        marker.corners_px = edges.unwrap_or(marker.corners_px);
    }
    let key = |marker: &Detection| {
        (marker.id, marker.outline_px[0].y as i64, marker.outline_px[0].x as i64)
    };
    distinct.sort_by_key(key);
    distinct
}

/// The marker with that outline, if it is one.
fn marker(image: &GreyImage, outline: [[f64; 2]; 4], dictionary: &Dictionary) -> Option<Detection> {
    let outline = outline.map(Point2::from);
    let corners = outward(&outline);
    let found = decode::decode(image, &corners, dictionary)?;
    // Turned clockwise by a quarter, the last corner becomes the first.
    let upright =
        |corners: &[Point2<f64>; 4]| [0, 1, 2, 3].map(|i| corners[(i + 4 - found.quarters) % 4]);
    Some(Detection { id: found.id, corners_px: upright(&corners), outline_px: upright(&outline) })
}

/// Half a pixel outward along both sides, from the centres of dark pixels to their edges.
fn outward(outline: &[Point2<f64>; 4]) -> [Point2<f64>; 4] {
    [0, 1, 2, 3].map(|i| {
        let corner = outline[i];
        let from =
            |k: usize| (corner - outline[(i + k) % 4]).try_normalize(0.0).unwrap_or_default();
        corner + (from(1) + from(3)) * 0.5
    })
}
