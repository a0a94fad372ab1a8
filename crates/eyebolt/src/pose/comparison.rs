//! Two poses against each other, pixel by pixel.

use super::judge::Judge;
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::Posture;

/// By how much a frame speaks for one pose against another.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Comparison {
    /// Sum over pixels of how much less the first one costs; positive where the frame is for it.
    pub advantage: f64,
    /// Standard deviation of that sum, as the differences between patches of the image show it.
    pub deviation: f64,
    /// Pixels where either says something.
    pub pixels: usize,
}

impl Comparison {
    /// Of two poses with their fingers, by depth with this standard deviation, metres.
    pub fn between(
        judge: &mut Judge<'_>,
        first: (&Posture, &Transform<Camera, Base>),
        second: (&Posture, &Transform<Camera, Base>),
        deviation_m: f64,
    ) -> Self {
        let (width, edge) = (judge.observed().image.width, judge.observed().patch_edge());
        let [first, second] =
            [first, second].map(|(posture, pose)| judge.costs(posture, pose, deviation_m));
        let across = width.div_ceil(edge).max(1);
        let down = first.len().div_ceil(width.max(1)).div_ceil(edge);
        let mut patches = vec![0.0; across * down];
        let mut pixels = 0;
        for (at, (a, b)) in first.iter().zip(&second).enumerate() {
            if a.is_none() && b.is_none() {
                continue;
            }
            pixels += 1;
            let patch = at / width / edge * across + at % width / edge;
            patches[patch] += f64::from(b.unwrap_or(0.0) - a.unwrap_or(0.0));
        }
        let advantage = patches.iter().sum();
        let variance: f64 = patches.iter().map(|difference| difference * difference).sum();
        Self { advantage, deviation: variance.sqrt(), pixels }
    }
}
