//! The arm as what moved between configurations, or was not there before.

use super::labeller::{Labeller, Labelling};
use crate::connected::connected;
use crate::depth_noise::DepthNoise;
use crate::evenly::evenly_others;
use crate::observations::{Configuration, Observations};
use eyebolt_registration::{Label, Labels, Margin};
use rayon::prelude::*;
use std::error::Error;

/// Depth that changes by less than this from one pixel to the next is one surface, metres at 1 m.
const CONTINUOUS_M: f32 = 0.015;
/// Smaller patches are noise: this share of the image.
const LEAST_PATCH: f64 = 2e-4;

/// What a pixel shows in one configuration, against all the others.
#[derive(Clone, Copy, PartialEq)]
enum Shown {
    /// The background, or no depth.
    Still,
    /// Before a background seen in another configuration.
    Moved,
    /// Seen in this configuration alone: nothing is known of what lies behind.
    Alone,
}

/// Takes the pixels that stand clearly before the farthest depth that other configurations saw
/// there, or frames without the arm; patches too small to be an arm are left out.
///
/// What several other configurations saw too is part of a scene that some do not show, such as a
/// person who left: the arm is hardly ever at the same place of the image at the same depth. Where no other configuration saw anything, a pixel counts if it continues the surface of one
/// that does.
#[derive(Clone, Copy, Debug)]
pub struct Motion;

impl Labeller for Motion {
    fn label(
        &self,
        observations: &Observations,
    ) -> Result<Labelling, Box<dyn Error + Send + Sync>> {
        let Observations { configurations, camera, .. } = observations;
        let farthest = Farthest::of(configurations, camera.pixel_count());
        let one = |(index, configuration): (usize, &Configuration)| {
            let motion = farthest.motion(observations, index);
            let width = configuration.depth.width() as usize;
            let set = grown(&motion, configuration.depth.depth_m(), width);
            Labels::from_fn(0..width, 0..configuration.depth.height() as usize, |u, v| {
                if set[v * width + u] { Label::Arm } else { Label::Background }
            })
        };
        let labels = configurations.par_iter().enumerate().map(one).collect();
        // Frames without the arm show the parts of it that never move, too.
        let whole_arm = observations.background.depth().is_some();
        Ok(Labelling { labels, whole_arm })
    }
}

/// The two farthest depths of each pixel over all configurations: what lies behind one of them is
/// the farthest that the others saw.
struct Farthest {
    depth_m: Vec<f32>,
    /// Which configuration saw that.
    seen_in: Vec<u32>,
    second_m: Vec<f32>,
}

impl Farthest {
    fn of(configurations: &[Configuration], pixels: usize) -> Self {
        let mut found = Self {
            depth_m: vec![0.0; pixels],
            seen_in: vec![0; pixels],
            second_m: vec![0.0; pixels],
        };
        let blocks = found.depth_m.par_chunks_mut(BLOCK).zip(found.seen_in.par_chunks_mut(BLOCK));
        let blocks = blocks.zip(found.second_m.par_chunks_mut(BLOCK)).enumerate();
        blocks.for_each(|(block, ((farthest, seen_in), second))| {
            for (number, configuration) in configurations.iter().enumerate() {
                let depth = configuration.depth.depth_m().iter().skip(block * BLOCK);
                let places = farthest.iter_mut().zip(seen_in.iter_mut()).zip(second.iter_mut());
                for (z, ((farthest, seen_in), second)) in depth.zip(places) {
                    if *z > *farthest {
                        (*second, *farthest, *seen_in) = (*farthest, *z, number as u32);
                    } else if *z > *second {
                        *second = *z;
                    }
                }
            }
        });
        found
    }

    /// What each pixel of configuration `index` shows.
    fn motion(&self, observations: &Observations, index: usize) -> Vec<Shown> {
        let Observations { configurations, noise, .. } = observations;
        let own = &configurations[index].depth;
        let background = observations.background.depth();
        // With frames of the scene alone nothing has to be voted on.
        let voters = if background.is_some() { Vec::new() } else { others(configurations, index) };
        let judge = |(at, z): (usize, &f32)| {
            let own_is_farthest = self.seen_in[at] as usize == index;
            let others = if own_is_farthest { self.second_m[at] } else { self.depth_m[at] };
            let behind =
                background.map_or(others, |background| background.depth_m()[at].max(others));
            match (*z > 0.0, behind > 0.0) {
                (false, _) => Shown::Still,
                (true, false) => Shown::Alone,
                (true, true) if *z >= behind - noise.margin_m(Margin::Moved, behind) => {
                    Shown::Still
                }
                (true, true) if is_common(&voters, at, *z, noise) => Shown::Still,
                (true, true) => Shown::Moved,
            }
        };
        own.depth_m().iter().enumerate().map(judge).collect()
    }
}

/// Other configurations that are asked whether they saw the same.
const MOST_OTHERS: usize = 8;
/// What so many of those that saw anything saw alike is the scene.
const COMMON_SHARE: f64 = 0.3;

/// Depth of some of the other `configurations`.
fn others(configurations: &[Configuration], own: usize) -> Vec<&[f32]> {
    let few = evenly_others(configurations.len(), own, MOST_OTHERS).into_iter();
    few.map(|other| configurations[other].depth.depth_m()).collect()
}

/// Whether several of `others` saw `z` at pixel `at` too.
fn is_common(others: &[&[f32]], at: usize, z: f32, noise: &DepthNoise) -> bool {
    let margin_m = noise.margin_m(Margin::Search, z);
    let seen = others.iter().map(|depth| depth[at]).filter(|other| *other > 0.0);
    let (mut count, mut same) = (0_usize, 0_usize);
    for other in seen {
        count += 1;
        same += usize::from((other - z).abs() <= margin_m);
    }
    same > 0 && same as f64 >= COMMON_SHARE * count as f64
}

/// Pixels that one task looks at.
const BLOCK: usize = 4096;

/// Connected patches of moved pixels, each with the lonely ones that continue its surface.
fn grown(motion: &[Shown], depth: &[f32], width: usize) -> Vec<bool> {
    let mut set = vec![false; motion.len()];
    let mut seen = vec![false; motion.len()];
    let least = (LEAST_PATCH * motion.len() as f64) as usize;
    let mut patch = Vec::new();
    for seed in 0..motion.len() {
        if motion[seed] != Shown::Moved || seen[seed] {
            continue;
        }
        seen[seed] = true;
        connected(seed, width, motion.len(), &mut patch, |at, other| {
            let near = (depth[other] - depth[at]).abs() < CONTINUOUS_M * depth[at].max(1.0);
            let joins = !seen[other] && motion[other] != Shown::Still && near;
            seen[other] |= joins;
            joins
        });
        if patch.len() >= least {
            for at in &patch {
                set[*at] = true;
            }
        }
    }
    set
}

#[cfg(test)]
mod tests;
