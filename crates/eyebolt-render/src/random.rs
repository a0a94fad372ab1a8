//! Random numbers that depend on a seed and a place, not on the order in which they are drawn.

/// SplitMix64 (Steele, Lea and Flood, *Fast splittable pseudorandom number generators*, OOPSLA
/// 2014): small, and the streams of any two places ([`Self::at`]) are unrelated, so that every pixel
/// of every frame can have a stream of its own, whichever thread draws it.
#[derive(Clone, Copy, Debug)]
pub struct Random {
    state: u64,
}

impl Random {
    /// The stream of `seed`.
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// The stream of `place` among those of this one, which does not move on.
    #[must_use]
    pub fn at(self, place: u64) -> Self {
        let mut mixed = Self { state: self.state ^ mix(place.wrapping_add(STEP)) };
        Self { state: mixed.next_u64() }
    }

    /// The next 64 bits.
    pub fn next_u64(&mut self) -> u64 {
        self.state = self.state.wrapping_add(STEP);
        mix(self.state)
    }

    /// Uniform in `[0, 1)`.
    pub fn uniform(&mut self) -> f64 {
        // 53 bits are what a float holds.
        (self.next_u64() >> 11) as f64 * 2.0_f64.powi(-53)
    }

    /// Uniform from `low` to `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.uniform()
    }

    /// Uniform in `0..count`; 0 if there is nothing to choose from.
    pub fn index(&mut self, count: usize) -> usize {
        ((self.uniform() * count as f64) as usize).min(count.saturating_sub(1))
    }

    /// Of mean 0 and variance 1 (Box and Muller, *A note on the generation of random normal
    /// deviates*, 1958).
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

/// The golden ratio's fraction of 2^64.
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_numbers() {
        // The first outputs of seed 1234567, as the article's reference implementation prints them.
        let mut random = Random::new(1_234_567);
        let drawn: Vec<u64> = (0..3).map(|_| random.next_u64()).collect();
        let published =
            [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423];
        assert_eq!(drawn, published);
    }

    #[test]
    fn moments_of_the_normal_distribution() {
        // 100 000 numbers, each the first of the stream of its place: what neighbouring pixels draw.
        let stream = Random::new(3);
        let count = 100_000_u64;
        let drawn: Vec<f64> = (0..count).map(|place| stream.at(place).normal()).collect();
        let moment = |power| drawn.iter().map(|x| x.powi(power)).sum::<f64>() / count as f64;
        // Four standard errors.
        assert!(moment(1).abs() < 0.013, "{}", moment(1));
        assert!((moment(2) - 1.0).abs() < 0.018, "{}", moment(2));
        assert!(moment(3).abs() < 0.05, "{}", moment(3));
        assert!((moment(4) - 3.0).abs() < 0.13, "{}", moment(4));
        let neighbours = drawn.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>();
        assert!((neighbours / count as f64).abs() < 0.013);
    }

    #[test]
    fn nothing_to_choose_from() {
        assert_eq!(Random::new(1).index(0), 0);
    }
}
