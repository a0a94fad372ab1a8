//! How much of what a camera sees changes.

use crate::noise_level::NoiseLevel;

/// How much of what a camera sees changes from image to image.
#[derive(Clone, Debug, Default)]
pub(super) struct DepthChange {
    samples: Vec<f32>,
    level: NoiseLevel,
    last_ns: Option<i64>,
    /// How many images in a row showed no change.
    still: u32,
    /// Whether images tell at all.
    tells: bool,
}

/// Depth that differs by this share is another thing's, and not noise.
const DIFFERENT: f32 = 0.03;
/// Images in a row without a change that tell that nothing moves.
const STILL_IMAGES: u32 = 3;
/// Shares of the pixels: fewer change in every image, and more do not change by chance.
const SMALLEST_LIMIT: f64 = 0.002;
const LARGEST_LIMIT: f64 = 0.05;
/// A camera that sent nothing for so long is not there.
const LATELY_NS: i64 = 2_000_000_000;

impl DepthChange {
    pub(super) fn add(&mut self, at_ns: i64, samples: Vec<f32>) {
        self.last_ns = Some(at_ns);
        self.tells = !samples.is_empty();
        let last = std::mem::replace(&mut self.samples, samples);
        if last.len() != self.samples.len() || last.is_empty() {
            self.still = 0;
            return;
        }
        let known = last.iter().zip(&self.samples).filter(|(a, b)| **a > 0.0 && **b > 0.0);
        let (count, changed) = known.fold((0_u32, 0_u32), |(count, changed), (a, b)| {
            (count + 1, changed + u32::from((a - b).abs() > DIFFERENT * a))
        });
        let share = f64::from(changed) / f64::from(count.max(1));
        self.level.add(share);
        match share <= self.level.limit(SMALLEST_LIMIT, LARGEST_LIMIT) {
            true => self.still = self.still.saturating_add(1),
            false => self.still = 0,
        }
    }

    /// Whether images came lately.
    pub(super) fn is_told(&self, at_ns: i64) -> bool {
        self.last_ns.is_some_and(|last| at_ns.saturating_sub(last) <= LATELY_NS)
    }

    /// Whether they show no change, or are clouds, which do not tell.
    pub(super) fn is_still(&self) -> bool {
        !self.tells || self.still >= STILL_IMAGES
    }
}
