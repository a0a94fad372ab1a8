//! How much of something there is while nothing happens.

/// Learns from what is measured again and again how much of it is noise: what the stillest quarter of the
/// measurements have. Memory does not grow.
#[derive(Clone, Debug)]
pub(crate) struct NoiseLevel {
    /// How many measurements are in each step of size, from the smallest.
    counts: [u32; STEPS],
    total: u32,
}

/// Steps of size, four for each doubling, from the smallest size that is told from none.
const STEPS: usize = 96;
const PER_DOUBLING: f64 = 4.0;
const SMALLEST: f64 = 1e-7;
/// What is older than so many measurements counts half.
const MEMORY: u32 = 4096;
/// Above what the stillest quarter has by so many times, something moves.
const ABOVE: f64 = 5.0;

impl Default for NoiseLevel {
    fn default() -> Self {
        Self { counts: [0; STEPS], total: 0 }
    }
}

impl NoiseLevel {
    /// Takes in a measurement; what is not a number tells nothing.
    pub(crate) fn add(&mut self, size: f64) {
        if size.is_nan() {
            return;
        }
        if self.total >= MEMORY {
            self.counts.iter_mut().for_each(|count| *count /= 2);
            self.total = self.counts.iter().sum();
        }
        if let Some(count) = self.counts.get_mut(step(size)) {
            *count += 1;
            self.total += 1;
        }
    }

    /// Above which size it is no noise, between `low` and `high`.
    pub(crate) fn limit(&self, low: f64, high: f64) -> f64 {
        (ABOVE * self.quarter()).clamp(low, high)
    }

    /// The size that a quarter of the measurements do not exceed, up to a step.
    fn quarter(&self) -> f64 {
        let (mut below, quarter) = (0, self.total / 4);
        for (step, count) in self.counts.iter().enumerate() {
            below += count;
            if below > quarter {
                return SMALLEST * (step as f64 / PER_DOUBLING).exp2();
            }
        }
        0.0
    }
}

fn step(size: f64) -> usize {
    let step = (size / SMALLEST).log2() * PER_DOUBLING;
    // Saturates: what is smaller than the smallest is in the first step.
    (step.ceil().max(0.0) as usize).min(STEPS - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Against the measurements themselves, sorted.
        #[test]
        fn the_quarter_is_that_of_the_measurements(
            mut sizes in proptest::collection::vec(1e-6..0.5_f64, 1..300),
        ) {
            let mut level = NoiseLevel::default();
            sizes.iter().for_each(|size| level.add(*size));
            sizes.sort_by(f64::total_cmp);
            let exact = sizes[sizes.len() / 4];
            let found = level.quarter();
            prop_assert!(found >= exact && found <= exact * (1.0 / PER_DOUBLING).exp2() * 1.000_001, "{found} {exact}");
        }

        #[test]
        fn it_forgets(first in 1e-5..1e-4_f64, then in 1e-2..1e-1_f64) {
            let mut level = NoiseLevel::default();
            (0..50_000).for_each(|_| level.add(first));
            (0..50_000).for_each(|_| level.add(then));
            prop_assert!(level.quarter() >= then);
        }
    }

    #[test]
    fn the_limit_keeps_within_its_bounds() {
        let mut level = NoiseLevel::default();
        assert_eq!(level.limit(5e-4, 5e-3), 5e-4);
        (0..10).for_each(|_| level.add(f64::INFINITY));
        level.add(f64::NAN);
        assert_eq!(level.limit(5e-4, 5e-3), 5e-3);
    }
}
