//! How numbers are spread: the quartiles, the tails, the shape.

/// Some finite numbers in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Spread(Vec<f32>);

impl Spread {
    /// Of those of `values` that are finite.
    pub(super) fn new(values: impl IntoIterator<Item = f32>) -> Self {
        let mut sorted: Vec<f32> = values.into_iter().filter(|value| value.is_finite()).collect();
        sorted.sort_unstable_by(f32::total_cmp);
        Self(sorted)
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.0.len()
    }

    /// The number below which `share` of them lie, interpolated between two of them; `None` if
    /// there is none.
    pub(super) fn quantile(&self, share: f32) -> Option<f32> {
        let last = self.0.len().checked_sub(1)?;
        let place = share.clamp(0.0, 1.0) * last as f32;
        let below = (place as usize).min(last);
        let (low, high) = (self.0.get(below)?, self.0.get((below + 1).min(last))?);
        Some(low + (high - low) * (place - below as f32))
    }

    /// How many lie in each of `bins` equal parts of `low..high`, smoothed over three of them, the
    /// largest being 1.
    pub(super) fn shape(&self, low: f32, high: f32, bins: usize) -> Vec<f32> {
        let mut counts = vec![0.0f32; bins];
        for value in self.0.iter().filter(|value| (low..high).contains(value)) {
            let bin = ((value - low) / (high - low) * bins as f32) as usize;
            if let Some(count) = counts.get_mut(bin) {
                *count += 1.0;
            }
        }
        let at = |index: Option<usize>| index.and_then(|i| counts.get(i)).copied().unwrap_or(0.0);
        let smooth =
            (0..bins).map(|i| 0.25 * (at(i.checked_sub(1)) + 2.0 * at(Some(i)) + at(Some(i + 1))));
        let smooth: Vec<f32> = smooth.collect();
        let most = smooth.iter().fold(0.0f32, |most, count| most.max(*count));
        smooth.iter().map(|count| if most > 0.0 { count / most } else { 0.0 }).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Spread;
    use proptest::prelude::*;
    use proptest::test_runner::{Config, RngSeed};

    fn config() -> Config {
        let rng_seed = RngSeed::Fixed(7);
        Config { rng_seed, failure_persistence: None, ..Config::default() }
    }

    proptest! {
        #![proptest_config(config())]

        #[test]
        fn half_of_the_numbers_lie_on_either_side_of_the_median(
            values in prop::collection::vec(-50.0..50.0f32, 1..60),
        ) {
            let spread = Spread::new(values.iter().copied().chain([f32::NAN, f32::INFINITY]));
            prop_assert_eq!(spread.count(), values.len());
            let median = spread.quantile(0.5).unwrap();
            prop_assert!(2 * values.iter().filter(|v| **v < median).count() <= values.len());
            prop_assert!(2 * values.iter().filter(|v| **v > median).count() <= values.len());
        }

        #[test]
        fn quantiles_rise_from_the_least_to_the_largest(
            values in prop::collection::vec(-50.0..50.0f32, 1..60), a in 0.0..1.0f32, b in 0.0..1.0f32,
        ) {
            let spread = Spread::new(values.iter().copied());
            let least = values.iter().copied().fold(f32::INFINITY, f32::min);
            let largest = values.iter().copied().fold(f32::NEG_INFINITY, f32::max);
            prop_assert_eq!(spread.quantile(0.0), Some(least));
            prop_assert_eq!(spread.quantile(1.0), Some(largest));
            prop_assert!(spread.quantile(a.min(b)) <= spread.quantile(a.max(b)));
        }

        #[test]
        fn the_shape_has_one_bin_of_height_one_and_none_beyond(
            values in prop::collection::vec(-50.0..50.0f32, 1..60),
        ) {
            let shape = Spread::new(values).shape(-50.0, 50.0, 20);
            prop_assert_eq!(shape.len(), 20);
            prop_assert_eq!(shape.iter().copied().fold(0.0, f32::max), 1.0);
            prop_assert!(shape.iter().all(|height| (0.0..=1.0).contains(height)));
        }
    }

    #[test]
    fn nothing_has_no_median_and_no_shape() {
        let nothing = Spread::default();
        assert_eq!(nothing.quantile(0.5), None);
        assert_eq!(nothing.shape(0.0, 1.0, 3), [0.0; 3]);
    }
}
