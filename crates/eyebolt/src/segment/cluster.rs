//! An arm is one thing, and so is its end-effector.

use eyebolt_geometry::{DepthImage, RayTable};
use std::collections::BTreeMap;

/// Points of an end-effector nearer to each other than about this belong together: single linkage, which on
/// a grid of cells is connected components (the paper's code cuts its linkage at 6 cm).
pub const END_EFFECTOR_LINKAGE_M: f32 = 0.06;
/// Of an arm, across which depth fails in patches.
pub const ARM_LINKAGE_M: f32 = 0.12;

/// Pixels within this part of the image's width are beside each other: depth fails where one surface ends
/// before another.
const BESIDE: usize = 100;

/// Parts of an arm that are beside each other in the image are not farther apart than this in depth, metres: one part hides
/// another that is at most an arm's length behind it, and a room is mostly farther away.
const APART_M: f32 = 1.0;

type Cell = [i32; 3];

/// Leaves their labels to the largest cluster of the points whose label is `of`, by its area, and gives the
/// others `instead`.
pub fn keep_largest_cluster(
    label: &mut [u8],
    depth: &DepthImage,
    rays: &RayTable,
    linkage_m: f32,
    of: impl Fn(u8) -> bool,
    instead: u8,
) {
    let clusters = clusters_by_area(label, depth, rays, linkage_m, of);
    for at in clusters.iter().skip(1).flat_map(|cluster| &cluster.pixels) {
        label[*at] = instead;
    }
}

/// Points that belong together.
#[derive(Clone, Debug, Default)]
pub struct Cluster {
    /// Their pixels, in order.
    pub pixels: Vec<usize>,
    /// Pixels times their depths squared: an area, but for the camera's focal length.
    pub area: f64,
}

/// Clusters of the points whose label is `of`, the largest first.
///
/// Points belong together that are near each other, or beside each other in the image: a forearm before its
/// upper arm is far from what it hides, and touches it.
pub fn clusters_by_area(
    label: &[u8],
    depth: &DepthImage,
    rays: &RayTable,
    linkage_m: f32,
    of: impl Fn(u8) -> bool,
) -> Vec<Cluster> {
    // Half the length: cells that touch hold points within it.
    let cell = |at: usize| {
        let point = rays.point(at, depth.depth_m()[at]);
        [0, 1, 2].map(|axis| (point[axis] / (0.5 * linkage_m)).floor() as i32)
    };
    let points: Vec<(usize, Cell)> =
        (0..label.len()).filter(|at| of(label[*at])).map(|at| (at, cell(at))).collect();
    let mut areas: BTreeMap<Cell, f64> = BTreeMap::new();
    for (at, cell) in &points {
        // A pixel covers an area that grows with the square of its depth.
        *areas.entry(*cell).or_default() += f64::from(depth.depth_m()[*at]).powi(2);
    }
    let mut clusters = clusters(&areas);
    let apart = (APART_M / (0.5 * linkage_m)) as i32;
    join_neighbours(&mut clusters, &points, depth.width() as usize, apart);
    let mut found: BTreeMap<usize, Cluster> = BTreeMap::new();
    areas.iter().for_each(|(cell, area)| found.entry(clusters[cell]).or_default().area += area);
    for (at, cell) in &points {
        found.entry(clusters[cell]).or_default().pixels.push(*at);
    }
    // A stable sort: the first of equally large ones stays first.
    let mut found: Vec<Cluster> = found.into_values().collect();
    found.sort_by(|a, b| b.area.total_cmp(&a.area));
    found
}

/// The cluster of each cell: cells that touch, corners included, belong together. Clusters are numbered
/// in the order of their least cells.
fn clusters(cells: &BTreeMap<Cell, f64>) -> BTreeMap<Cell, usize> {
    let mut of = BTreeMap::new();
    let mut next = 0;
    for seed in cells.keys() {
        if of.contains_key(seed) {
            continue;
        }
        let mut open = vec![*seed];
        of.insert(*seed, next);
        while let Some(cell) = open.pop() {
            for other in around(cell) {
                if cells.contains_key(&other) && !of.contains_key(&other) {
                    of.insert(other, next);
                    open.push(other);
                }
            }
        }
        next += 1;
    }
    of
}

/// Makes one of clusters that are beside each other in the image, and at most so many cells apart in depth. `points` are in
/// the order of their pixels.
fn join_neighbours(
    clusters: &mut BTreeMap<Cell, usize>,
    points: &[(usize, Cell)],
    width: usize,
    apart: i32,
) {
    let beside_px = width / BESIDE + 1;
    let mut into: Vec<usize> = (0..clusters.len()).collect();
    let root = |into: &[usize], mut of: usize| {
        while into[of] != of {
            of = into[of];
        }
        of
    };
    // Of each column, the last pixel, its cluster and how far away it is; and of the row.
    let mut above: Vec<Option<(usize, usize, i32)>> = vec![None; width];
    let mut before: Option<(usize, usize, i32)> = None;
    for (at, cell) in points {
        let (u, v, cluster, far) = (at % width, at / width, clusters[cell], cell[2]);
        let left = before.filter(|(other, ..)| other / width == v && at - other <= beside_px);
        let up = above[u].filter(|(row, ..)| v - row <= beside_px);
        for (_, other, there) in left.into_iter().chain(up) {
            if (far - there).abs() <= apart {
                let (a, b) = (root(&into, cluster), root(&into, other));
                into[a.max(b)] = a.min(b);
            }
        }
        before = Some((*at, cluster, far));
        above[u] = Some((v, cluster, far));
    }
    clusters.values_mut().for_each(|cluster| *cluster = root(&into, *cluster));
}

fn around(cell: Cell) -> impl Iterator<Item = Cell> {
    (0..27).map(move |step| {
        let by = [step / 9 - 1, step / 3 % 3 - 1, step % 3 - 1];
        [0, 1, 2].map(|axis| cell[axis].saturating_add(by[axis]))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use eyebolt_geometry::{Distortion, PinholeCamera};

    /// Three patches of a wall: two a little apart hang together, the third is elsewhere and smaller.
    #[test]
    fn the_largest_stays_with_what_is_near_it() {
        let camera =
            PinholeCamera::new(100, 40, 100.0, 100.0, 49.5, 19.5, Distortion::None).unwrap();
        let rays = RayTable::new(&camera);
        let depth = DepthImage::new(100, 40, vec![1.0; 4000]).unwrap();
        // A pixel is 1 cm wide.
        let patch = |at: usize| match at % 100 {
            10..30 => 2,
            33..50 => 2,
            70..85 => 2,
            _ => 0,
        };
        let mut label: Vec<u8> = (0..4000).map(patch).collect();
        keep_largest_cluster(&mut label, &depth, &rays, 0.06, |label| label == 2, 1);
        for (at, found) in label.iter().enumerate() {
            let wanted = if (70..85).contains(&(at % 100)) { 1 } else { patch(at) };
            assert_eq!(*found, wanted, "{}", at % 100);
        }
        // The third is farther away, and touches the second in the image.
        let depth_m = (0..4000).map(|at| if at % 100 < 52 { 1.0 } else { 1.6 }).collect();
        let depth = DepthImage::new(100, 40, depth_m).unwrap();
        let patch = |at: usize| u8::from((33..70).contains(&(at % 100)));
        let mut label: Vec<u8> = (0..4000).map(patch).collect();
        keep_largest_cluster(&mut label, &depth, &rays, 0.06, |label| label == 1, 0);
        assert!((0..4000).all(|at| label[at] == patch(at)));
        // So far away that it is a wall behind: then it is another thing, of a larger area.
        let depth_m = (0..4000).map(|at| if at % 100 < 52 { 1.0 } else { 4.0 }).collect();
        let depth = DepthImage::new(100, 40, depth_m).unwrap();
        keep_largest_cluster(&mut label, &depth, &rays, 0.06, |label| label == 1, 0);
        assert!((0..4000).all(|at| label[at] == u8::from((52..70).contains(&(at % 100)))));
        keep_largest_cluster(&mut [0; 4000], &depth, &rays, 0.06, |label| label == 2, 1);
    }
}
