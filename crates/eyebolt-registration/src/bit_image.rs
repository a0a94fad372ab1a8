//! Images of one bit a pixel, 64 pixels a word: what lies near something, for small distances.

/// Rows of bits; those beyond the width are zero.
pub(crate) struct BitImage {
    width: usize,
    height: usize,
    /// Words of a row.
    stride: usize,
    words: Vec<u64>,
}

impl BitImage {
    /// The image of `width` x `height` pixels, of which those are set that `is_set` says, row by row.
    pub fn from_fn(width: usize, height: usize, mut is_set: impl FnMut(usize) -> bool) -> Self {
        let stride = width.div_ceil(64);
        let mut words = vec![0u64; stride * height];
        for at in 0..width * height {
            let (u, v) = (at % width, at / width);
            words[v * stride + u / 64] |= u64::from(is_set(at)) << (u % 64);
        }
        Self { width, height, stride, words }
    }

    /// The pixels no farther than `radius` pixels from one that is set; within the image.
    pub fn dilated(&self, radius: f32) -> Self {
        let mut found = vec![0u64; self.words.len()];
        let mut wide = vec![0u64; self.stride];
        let reach = radius.max(0.0) as usize;
        for v in 0..self.height {
            let row = self.row(v);
            if row.iter().all(|word| *word == 0) {
                continue;
            }
            // Rows farther away get narrower pieces of the disc, so the widest comes last.
            wide.copy_from_slice(row);
            let mut half = 0;
            for dv in (0..=reach).rev() {
                let Some(wanted) = half_width(dv, radius) else { continue };
                while half < wanted {
                    half += 1;
                    spread(row, half, &mut wide);
                }
                for other in [v.checked_sub(dv), Some(v + dv)].into_iter().flatten() {
                    if other < self.height {
                        let into = &mut found[other * self.stride..(other + 1) * self.stride];
                        into.iter_mut().zip(&wide).for_each(|(into, wide)| *into |= wide);
                    }
                }
            }
        }
        let mut dilated = Self { words: found, ..*self };
        dilated.clear_beyond_width();
        dilated
    }

    /// The pixels that are not set.
    pub fn inverted(&self) -> Self {
        let words = self.words.iter().map(|word| !word).collect();
        let mut inverted = Self { words, ..*self };
        inverted.clear_beyond_width();
        inverted
    }

    /// Whether each pixel is set, row by row.
    pub fn to_bools(&self) -> Vec<bool> {
        let mut set = Vec::with_capacity(self.width * self.height);
        for v in 0..self.height {
            let row = self.row(v);
            set.extend((0..self.width).map(|u| row[u / 64] >> (u % 64) & 1 == 1));
        }
        set
    }

    fn row(&self, v: usize) -> &[u64] {
        &self.words[v * self.stride..(v + 1) * self.stride]
    }

    fn clear_beyond_width(&mut self) {
        let rest = self.width % 64;
        if rest != 0 {
            for last in self.words.iter_mut().skip(self.stride - 1).step_by(self.stride) {
                *last &= (1u64 << rest) - 1;
            }
        }
    }
}

/// How far a disc of `radius` reaches to either side in the row that is `dv` off its middle.
fn half_width(dv: usize, radius: f32) -> Option<usize> {
    let inside = |du: &usize| ((du * du + dv * dv) as f32).sqrt() <= radius;
    (0..=radius.max(0.0) as usize).take_while(inside).last()
}

/// Adds `row`, moved by `by` pixels to either side, to `wide`.
fn spread(row: &[u64], by: usize, wide: &mut [u64]) {
    let (words, bits) = (by / 64, by % 64);
    for (at, into) in wide.iter_mut().enumerate() {
        let word = |index: Option<usize>| index.and_then(|i| row.get(i)).copied().unwrap_or(0);
        let (left, right) = (at.checked_sub(words), at.checked_add(words));
        *into |= word(left) << bits | word(right) >> bits;
        if bits > 0 {
            let (carried, brought) = (left.and_then(|i| i.checked_sub(1)), right.map(|i| i + 1));
            *into |= word(carried) >> (64 - bits) | word(brought) << (64 - bits);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image_distance::distance_to;
    use proptest::prelude::*;
    use proptest::test_runner::{Config, RngSeed};

    fn config() -> Config {
        let rng_seed = RngSeed::Fixed(7);
        Config { rng_seed, failure_persistence: None, ..Config::default() }
    }

    proptest! {
        #![proptest_config(config())]

        #[test]
        fn what_is_near_is_what_the_distance_says(
            width in 1_usize..150, height in 1_usize..12, radius in 0.0..5.5_f32,
            seeds in prop::collection::vec(any::<prop::sample::Index>(), 0..9),
        ) {
            let mut set = vec![false; width * height];
            seeds.iter().for_each(|seed| set[seed.index(width * height)] = true);
            let image = BitImage::from_fn(width, height, |at| set[at]);
            prop_assert_eq!(image.to_bools(), set.clone());
            let distance = distance_to(&set, width, height);
            let near: Vec<bool> = distance.iter().map(|d| *d <= radius).collect();
            prop_assert_eq!(image.dilated(radius).to_bools(), near.clone());
            let far: Vec<bool> = near.iter().map(|near| !near).collect();
            prop_assert_eq!(image.dilated(radius).inverted().to_bools(), far);
        }
    }

    #[test]
    fn an_image_without_pixels_has_none() {
        let nothing = BitImage::from_fn(0, 3, |_| true);
        assert!(nothing.dilated(2.0).inverted().to_bools().is_empty());
    }
}
