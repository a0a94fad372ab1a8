//! How much depth of the same thing differs from one configuration to the next, as the recording
//! itself shows it.
//!
//! Most pixels show the same surface in two configurations. How far apart they are there tells the
//! noise at that depth: what a camera's data sheet does not say of a white wall five metres away.

use crate::evenly::evenly_others;
use eyebolt_geometry::DepthImage;
use eyebolt_registration::{Margin, median};
use rayon::prelude::*;

/// Standard deviation of depth, as a function of depth.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthNoise {
    /// Of each bin, as a share of the squared depth (1/m); what is not seen is as its neighbour.
    by_bin: Vec<f32>,
}

/// The nearest depth told apart, metres, and the ratio from one bin to the next.
const NEAREST_M: f32 = 0.25;
const RATIO: f32 = 1.2;
/// Up to 14 metres.
const BINS: usize = 22;
/// With fewer pixels a bin says nothing.
const LEAST_SAMPLES: usize = 300;
/// Pixels looked at of each pair of configurations.
const SAMPLES: usize = 60_000;
/// Of the differences sorted by size, the one that tells the noise: where less than half of the
/// pixels moved, it is one of those that did not.
const QUANTILE: f64 = 0.25;
/// That quantile of the size of a difference of two unit normals.
const AT_QUANTILE: f32 = 0.3186 * std::f32::consts::SQRT_2;
/// Differences beyond this many standard deviations are not noise.
const SIGMAS: f32 = 4.0;

impl DepthNoise {
    /// What `images` of one camera show, each beside the one that is most like it: the scene of another
    /// may have changed.
    pub fn learn(images: &[&DepthImage]) -> Self {
        let beside: Vec<(usize, usize)> = (0..images.len())
            .into_par_iter()
            .filter_map(|own| most_alike(images, own).map(|other| (own, other)))
            .collect();
        let mut differences: Vec<Vec<f32>> = vec![Vec::new(); BINS];
        for (own, other) in beside {
            for (nearer, difference) in compared(images[own], images[other], SAMPLES) {
                differences[bin(nearer)].push(difference);
            }
        }
        let limit = largest(&differences);
        let of_bin = |differences| deviation(differences).map(|share| share.min(limit));
        let mut by_bin: Vec<Option<f32>> = differences.into_iter().map(of_bin).collect();
        // From the near to the far, then the other way for what lies before the first.
        for bin in 1..BINS {
            by_bin[bin] = by_bin[bin].or(by_bin[bin - 1]);
        }
        for bin in (1..BINS).rev() {
            by_bin[bin - 1] = by_bin[bin - 1].or(by_bin[bin]);
        }
        Self { by_bin: by_bin.into_iter().map(Option::unwrap_or_default).collect() }
    }

    /// Standard deviation at `depth_m`, metres.
    pub fn deviation_m(&self, depth_m: f32) -> f32 {
        self.by_bin.get(bin(depth_m)).map_or(0.0, |share| share * depth_m * depth_m)
    }

    /// What a difference of depth at `depth_m` has to exceed not to be noise, metres: `margin`, and
    /// more where the recording shows more.
    pub fn margin_m(&self, margin: Margin, depth_m: f32) -> f32 {
        margin.at_m(depth_m).max(SIGMAS * self.deviation_m(depth_m))
    }
}

/// Pixels that tell how much alike two images are, and how many others each is compared with.
const FEW_SAMPLES: usize = 3000;
const MOST_OTHERS: usize = 8;

/// The one of the other images that differs least from number `own`.
fn most_alike(images: &[&DepthImage], own: usize) -> Option<usize> {
    let others = evenly_others(images.len(), own, MOST_OTHERS);
    let apart = |other: usize| {
        let pairs = compared(images[own], images[other], FEW_SAMPLES);
        let mut differences: Vec<f64> =
            pairs.map(|(_, difference)| f64::from(difference)).collect();
        Some((other, median(&mut differences)?))
    };
    let all = others.into_iter().filter_map(apart);
    all.min_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(other, _)| other)
}

/// The nearer depth and the difference, as a share of its square, of about `count` pixels that both
/// images saw.
fn compared(a: &DepthImage, b: &DepthImage, count: usize) -> impl Iterator<Item = (f32, f32)> {
    // Odd, so that of images of even width no column is left out.
    let stride = (a.depth_m().len() / count).max(1) | 1;
    let pairs = a.depth_m().iter().zip(b.depth_m()).step_by(stride);
    pairs.filter(|(a, b)| **a > 0.0 && **b > 0.0).map(|(a, b)| {
        let nearer = a.min(*b);
        (nearer, (a - b).abs() / (nearer * nearer))
    })
}

fn bin(depth_m: f32) -> usize {
    ((depth_m / NEAREST_M).ln() / RATIO.ln()).clamp(0.0, (BINS - 1) as f32) as usize
}

/// At some depths there may be nothing but the arm, which moves: no bin has more noise than this many
/// times that of all together, nor than this share of the squared depth (1/m), a disparity off by more
/// than two pixels of most stereo cameras.
const LARGEST_RATIO: f32 = 3.0;
const LARGEST_SHARE: f32 = 0.05;

/// The largest deviation that a bin is taken to have.
fn largest(differences: &[Vec<f32>]) -> f32 {
    let all = differences.iter().flatten().copied().collect();
    deviation(all).map_or(LARGEST_SHARE, |all| (LARGEST_RATIO * all).min(LARGEST_SHARE))
}

/// Standard deviation that `differences` show; `None` of too few.
fn deviation(mut differences: Vec<f32>) -> Option<f32> {
    if differences.len() < LEAST_SAMPLES {
        return None;
    }
    let at = (QUANTILE * differences.len() as f64) as usize;
    let (_, difference, _) = differences.select_nth_unstable_by(at, f32::total_cmp);
    Some(*difference / AT_QUANTILE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use eyebolt_render::Random;

    const WIDTH: u32 = 160;
    const HEIGHT: u32 = 120;

    /// A wall at `depth_m` with this noise, a third of which stands 0.4 m farther ahead.
    fn wall(depth_m: f64, deviation_m: f64, seed: u64, in_front: usize) -> DepthImage {
        let mut random = Random::new(seed);
        let pixels = (0..(WIDTH * HEIGHT) as usize).map(|at| {
            let moved = at * 3 / (WIDTH * HEIGHT) as usize == in_front;
            let true_m = if moved { depth_m - 0.4 } else { depth_m };
            (true_m + deviation_m * random.normal()) as f32
        });
        DepthImage::new(WIDTH, HEIGHT, pixels.collect()).unwrap()
    }

    #[test]
    fn what_moves_does_not_count_as_noise() {
        for (depth_m, deviation_m) in [(1.2, 0.004), (5.0, 0.2)] {
            let images: Vec<DepthImage> =
                (0..3).map(|i| wall(depth_m, deviation_m, i as u64, i)).collect();
            let noise = DepthNoise::learn(&images.iter().collect::<Vec<_>>());
            let ratio = f64::from(noise.deviation_m(depth_m as f32)) / deviation_m;
            assert!((0.8..2.5).contains(&ratio), "{ratio}");
        }
    }

    /// Nothing but what moves is near, before a wall.
    #[test]
    fn depths_at_which_all_moves_tell_nothing() {
        let image = |at: usize| {
            let pixels = (0..(WIDTH * HEIGHT) as usize).map(|pixel| {
                let near = pixel * 4 / (WIDTH * HEIGHT) as usize == at;
                if near { 0.8 + 0.1 * at as f32 } else { 2.0 }
            });
            DepthImage::new(WIDTH, HEIGHT, pixels.collect()).unwrap()
        };
        let images: Vec<DepthImage> = (0..3).map(image).collect();
        let noise = DepthNoise::learn(&images.iter().collect::<Vec<_>>());
        assert_eq!(noise.margin_m(Margin::Moved, 0.9), Margin::Moved.at_m(0.9));
    }

    #[test]
    fn one_image_tells_nothing_and_the_margin_is_that_of_any_camera() {
        let noise = DepthNoise::learn(&[&wall(1.0, 0.01, 1, 9)]);
        assert_eq!(noise.deviation_m(1.0), 0.0);
        assert_eq!(noise.margin_m(Margin::Moved, 1.0), Margin::Moved.at_m(1.0));
    }
}
