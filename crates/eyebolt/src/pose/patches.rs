//! Connected patches of pixels: the arm may be one of several things that moved.

use crate::connected::connected;
use crate::observations::{Configuration, Observations};
use eyebolt_geometry::Mask;
use nalgebra::{Point3, Vector3};

/// Patches looked at besides the whole.
const PATCHES: usize = 4;
/// A patch smaller than this share of all pixels is not the arm, or not enough of it.
const LEAST_SHARE: f64 = 0.05;
/// Depth that changes by less than this from one pixel to the next is one surface, metres at 1 m.
const CONTINUOUS_M: f32 = 0.05;

/// Mean of all points seen at the pixels of `mask`, then of each of its largest patches, camera frame.
pub(super) fn middles(
    observations: &Observations,
    configuration: &Configuration,
    mask: &Mask,
) -> Vec<Point3<f32>> {
    let depth = configuration.depth.depth_m();
    let mut open: Vec<bool> =
        mask.as_slice().iter().zip(depth).map(|(set, z)| *set && *z > 0.0).collect();
    let width = mask.width() as usize;
    let mut patches: Vec<(usize, Vector3<f64>)> = Vec::new();
    let mut patch = Vec::new();
    for seed in 0..open.len() {
        if !std::mem::take(&mut open[seed]) {
            continue;
        }
        connected(seed, width, depth.len(), &mut patch, |at, other| {
            let near = (depth[other] - depth[at]).abs() < CONTINUOUS_M * depth[at].max(1.0);
            near && std::mem::take(&mut open[other])
        });
        let point = |at: &usize| observations.rays.point(*at, depth[*at]).coords.cast::<f64>();
        let sum: Vector3<f64> = patch.iter().map(point).sum();
        patches.push((patch.len(), sum));
    }
    let all: usize = patches.iter().map(|(count, _)| count).sum();
    let total: Vector3<f64> = patches.iter().map(|(_, sum)| sum).sum();
    // Stable, so that of two as large the first stays first.
    patches.sort_by_key(|(count, _)| std::cmp::Reverse(*count));
    patches.retain(|(count, _)| *count as f64 >= LEAST_SHARE * all as f64);
    patches.truncate(PATCHES);
    let mean = |(count, sum): (usize, Vector3<f64>)| Point3::from((sum / count as f64).cast());
    let several = patches.len() > 1;
    let each = patches.into_iter().filter(|_| several);
    std::iter::once((all, total)).filter(|(all, _)| *all > 0).chain(each).map(mean).collect()
}

#[cfg(test)]
mod tests;
