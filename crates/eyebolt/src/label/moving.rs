//! The arm as what moved between configurations, or was not there before.

use crate::session::Configuration;
use eyebolt_geometry::{DepthImage, Mask};
use eyebolt_registration::View;
use rayon::prelude::*;

/// Depth that changes by less than this from one pixel to the next is one surface, metres at 1 m.
const CONTINUOUS_M: f32 = 0.015;
/// Smaller patches are noise: this share of the image.
const LEAST_PATCH: f64 = 2e-4;

/// What a pixel shows in one configuration, against all the others.
#[derive(Clone, Copy, PartialEq)]
enum Motion {
    /// The background, or no depth.
    Still,
    /// Before a background seen in another configuration.
    Moved,
    /// Seen in this configuration alone: nothing is known of what lies behind.
    Alone,
}

/// For each configuration the pixels that stand clearly before the farthest depth that the other
/// configurations saw there, or the `background` without the arm; patches too small to be an arm
/// are left out.
///
/// Where no other configuration saw anything, a pixel counts if it continues the surface of one
/// that does.
pub fn moving_masks(
    configurations: &[Configuration],
    background: Option<&DepthImage>,
) -> Vec<Mask> {
    let Some(first) = configurations.first() else { return Vec::new() };
    let (width, height) = (first.depth.width(), first.depth.height());
    (0..configurations.len())
        .into_par_iter()
        .map(|index| {
            let motion = motion(configurations, background, index);
            let depth = configurations[index].depth.depth_m();
            let set = grown(&motion, depth, width as usize);
            Mask::new(width, height, set).expect("as many pixels as the depth image")
        })
        .collect()
}

fn motion(
    configurations: &[Configuration],
    background: Option<&DepthImage>,
    index: usize,
) -> Vec<Motion> {
    let own = configurations[index].depth.depth_m();
    let others = configurations.iter().enumerate().filter(|(other, _)| *other != index);
    let mut behind = vec![0f32; own.len()];
    for depth in others.map(|(_, configuration)| &configuration.depth).chain(background) {
        for (farthest, z) in behind.iter_mut().zip(depth.depth_m()) {
            *farthest = farthest.max(*z);
        }
    }
    let judge = |(z, behind): (&f32, &f32)| match (*z > 0.0, *behind > 0.0) {
        (false, _) => Motion::Still,
        (true, false) => Motion::Alone,
        (true, true) if *z < behind - 1.5 * View::tolerance_m(*behind) => Motion::Moved,
        (true, true) => Motion::Still,
    };
    own.iter().zip(&behind).map(judge).collect()
}

/// Connected patches of moved pixels, each with the lonely ones that continue its surface.
fn grown(motion: &[Motion], depth: &[f32], width: usize) -> Vec<bool> {
    let mut set = vec![false; motion.len()];
    let mut seen = vec![false; motion.len()];
    let least = (LEAST_PATCH * motion.len() as f64) as usize;
    let mut patch = Vec::new();
    for seed in 0..motion.len() {
        if motion[seed] != Motion::Moved || seen[seed] {
            continue;
        }
        patch.clear();
        patch.push(seed);
        seen[seed] = true;
        let mut next = 0;
        while let Some(&at) = patch.get(next) {
            next += 1;
            for other in neighbours(at, width, motion.len()).into_iter().flatten() {
                let near = (depth[other] - depth[at]).abs() < CONTINUOUS_M * depth[at].max(1.0);
                if !seen[other] && motion[other] != Motion::Still && near {
                    seen[other] = true;
                    patch.push(other);
                }
            }
        }
        if patch.len() >= least {
            for at in &patch {
                set[*at] = true;
            }
        }
    }
    set
}

fn neighbours(at: usize, width: usize, count: usize) -> [Option<usize>; 4] {
    let column = at % width;
    [
        (column > 0).then(|| at - 1),
        (column + 1 < width).then(|| at + 1),
        at.checked_sub(width),
        (at + width < count).then(|| at + width),
    ]
}
