//! The end-effector is one thing.

use eyebolt_geometry::{DepthImage, PinholeCamera, RayTable};
use std::collections::HashMap;

/// Points nearer to each other than about this belong together: single linkage, which on a grid of cells
/// of that edge is connected components (the paper's code cuts its linkage at 6 cm).
const LINKAGE_M: f32 = 0.06;

/// Leaves `class` to the largest cluster of its points and gives the others `instead`.
pub fn keep_largest_cluster(
    label: &mut [u8],
    depth: &DepthImage,
    camera: &PinholeCamera,
    class: u8,
    instead: u8,
) {
    let rays = RayTable::new(camera);
    // A cell of half the length: neighbours touch, and points of neighbouring cells are within it.
    let cell = |at: usize| {
        let point = rays.point(at, depth.depth_m()[at]);
        [0, 1, 2].map(|axis| (point[axis] / (0.5 * LINKAGE_M)).floor() as i32)
    };
    let points: Vec<(usize, [i32; 3])> =
        (0..label.len()).filter(|at| label[*at] == class).map(|at| (at, cell(at))).collect();
    let mut counts: HashMap<[i32; 3], usize> = HashMap::new();
    points.iter().for_each(|(_, cell)| *counts.entry(*cell).or_default() += 1);
    let clusters = clusters(&counts);
    let mut sizes: HashMap<usize, usize> = HashMap::new();
    counts.iter().for_each(|(cell, count)| *sizes.entry(clusters[cell]).or_default() += count);
    // The first of equally large ones.
    let Some(best) =
        sizes.iter().max_by_key(|(cluster, size)| (**size, std::cmp::Reverse(**cluster)))
    else {
        return;
    };
    let best = *best.0;
    for (at, _) in points.iter().filter(|(_, cell)| clusters[cell] != best) {
        label[*at] = instead;
    }
}

/// The cluster of each cell: cells that touch, corners included, belong together. Clusters are numbered
/// in the order of their least cells.
fn clusters(counts: &HashMap<[i32; 3], usize>) -> HashMap<[i32; 3], usize> {
    let mut cells: Vec<[i32; 3]> = counts.keys().copied().collect();
    cells.sort_unstable();
    let mut of = HashMap::new();
    let mut next = 0;
    for seed in cells {
        if of.contains_key(&seed) {
            continue;
        }
        let mut open = vec![seed];
        of.insert(seed, next);
        while let Some([x, y, z]) = open.pop() {
            for step in 0..27 {
                let [dx, dy, dz] = [step / 9 - 1, step / 3 % 3 - 1, step % 3 - 1];
                let [Some(x), Some(y), Some(z)] =
                    [x.checked_add(dx), y.checked_add(dy), z.checked_add(dz)]
                else {
                    continue;
                };
                let cell = [x, y, z];
                if counts.contains_key(&cell) && !of.contains_key(&cell) {
                    of.insert(cell, next);
                    open.push(cell);
                }
            }
        }
        next += 1;
    }
    of
}
