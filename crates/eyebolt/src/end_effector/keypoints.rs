//! Which corners are keypoints.

use super::corners::Corner;
use super::symmetry::Symmetry;
use nalgebra::{Point3, Vector3};

/// A rigid fit is sure with this many.
pub const FEWEST_KEYPOINTS: usize = 4;
/// More make a network no surer.
pub const MOST_KEYPOINTS: usize = 8;
/// Keypoints are at least this far apart, as a share of the size, if there are enough of them.
const APART: f64 = 0.15;
/// The first on each part counts as this many times as far from the others: fingers are where a hand
/// is least like a box.
const NEW_PART: f64 = 2.0;
/// An image under a symmetry this near to a corner is that corner, as a share of the size.
const SAME: f64 = 0.05;

/// A point of the end-effector that can be told from the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Keypoint {
    /// Index of the link that it is fixed to, in [`eyebolt_robot::Robot::links`].
    pub link: usize,
    /// Where on it, link frame, metres.
    pub point_in_link: Point3<f64>,
}

/// Corners far apart from each other, the sharp ones first, from four to eight; together with all of
/// their images under `symmetry`, so that partners can be exchanged for each other. Fewer only if
/// the shape has no more.
pub(super) fn choose(corners: &[Corner], symmetry: &Symmetry, size_m: f64) -> Vec<Corner> {
    let mut chosen: Vec<Corner> = Vec::new();
    let mut left: Vec<Corner> = corners.to_vec();
    while chosen.len() < MOST_KEYPOINTS {
        let Some(best) = best(&left, &chosen, size_m) else { break };
        let corner = left.swap_remove(best);
        let apart_m = nearest_m(&chosen, &corner.point);
        if (chosen.len() >= FEWEST_KEYPOINTS && apart_m < APART * size_m) || apart_m <= 0.0 {
            break;
        }
        let images = images(&corner, corners, symmetry, size_m);
        let fits = chosen.len() + images.len() <= MOST_KEYPOINTS;
        let is_new = |image: &Corner| nearest_m(&chosen, &image.point) > SAME * size_m;
        if fits && images.iter().all(is_new) {
            chosen.extend(images);
        }
    }
    chosen
}

/// `corner` and the corners that a symmetry takes it to; of a full turn only itself.
fn images(corner: &Corner, all: &[Corner], symmetry: &Symmetry, size_m: f64) -> Vec<Corner> {
    let mut found = vec![*corner];
    let turns = match symmetry {
        Symmetry::Fold { .. } => symmetry.turns(),
        // The images of a corner under every turn are a circle.
        Symmetry::None | Symmetry::Axis { .. } => Vec::new(),
    };
    for turned in turns.iter().map(|turn| turn * corner.point) {
        let away = |other: &Corner| (other.point - turned).norm();
        let nearest = all.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
        let Some(image) = nearest.filter(|image| away(image) < SAME * size_m) else { continue };
        if nearest_m(&found, &image.point) > SAME * size_m {
            found.push(*image);
        }
    }
    found
}

/// The sharpest of those far from what is chosen; the first is far from the middle.
fn best(left: &[Corner], chosen: &[Corner], size_m: f64) -> Option<usize> {
    let count = left.len().max(1) as f64;
    let middle = Point3::from(left.iter().map(|c| c.point.coords).sum::<Vector3<f64>>() / count);
    let score = |corner: &Corner| {
        let apart_m = match chosen {
            [] => (corner.point - middle).norm(),
            _ => nearest_m(chosen, &corner.point),
        };
        // Equals are told apart by a direction along which no shape is alike, not by rounding errors.
        let odd = corner.point.coords.dot(&Vector3::new(0.53, 0.67, 0.52)) / size_m;
        let unseen = chosen.iter().all(|other| other.part != corner.part);
        let favour = if unseen { NEW_PART } else { 1.0 };
        favour * apart_m * corner.sharpness.cbrt() * (1.0 + 1e-3 * odd)
    };
    let scores = left.iter().map(score).enumerate();
    scores.max_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(index, _)| index)
}

fn nearest_m(chosen: &[Corner], point: &Point3<f64>) -> f64 {
    let distances = chosen.iter().map(|corner| (corner.point - point).norm());
    distances.fold(f64::INFINITY, f64::min)
}

/// Which keypoint each becomes by each turn of `symmetry`, the identity first; turns that do not
/// take every keypoint to another are left out.
pub(super) fn permutations(
    points: &[Point3<f64>],
    symmetry: &Symmetry,
    size_m: f64,
) -> Vec<Vec<usize>> {
    let mut all = vec![(0..points.len()).collect::<Vec<_>>()];
    for turn in symmetry.turns() {
        let image = |point: &Point3<f64>| {
            let turned = turn * point;
            points.iter().position(|other| (other - turned).norm() < SAME * size_m)
        };
        let permutation: Option<Vec<usize>> = points.iter().map(image).collect();
        all.extend(permutation.filter(|permutation| !all.contains(permutation)));
    }
    all
}
