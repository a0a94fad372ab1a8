//! Distances in an image, exact and linear in the number of pixels.

/// Distance in pixels from each pixel of a `width` x `height` image to the nearest one of `set`
/// (Felzenszwalb and Huttenlocher, *Theory of Computing*, 2012); infinite if there is none.
pub(crate) fn distance_to(set: &[bool], width: usize, height: usize) -> Vec<f32> {
    if width == 0 {
        return Vec::new();
    }
    let mut squared: Vec<f32> = set.iter().map(|s| if *s { 0.0 } else { f32::INFINITY }).collect();
    // Columns first as a running count, then rows as a lower envelope of parabolas.
    for forward in [true, false] {
        for step in 1..height {
            let v = if forward { step } else { height - 1 - step };
            let from = if forward { v - 1 } else { v + 1 };
            for u in 0..width {
                let next = squared[from * width + u] + 1.0;
                let at = &mut squared[v * width + u];
                *at = at.min(next);
            }
        }
    }
    let mut envelope = Envelope::new(width);
    for row in squared.chunks_exact_mut(width) {
        for value in row.iter_mut() {
            *value *= *value;
        }
        envelope.transform(row);
        for value in row {
            *value = value.sqrt();
        }
    }
    squared
}

/// Buffers of the one-dimensional transform.
struct Envelope {
    input: Vec<f32>,
    vertex: Vec<usize>,
    start: Vec<f32>,
}

impl Envelope {
    fn new(length: usize) -> Self {
        Self { input: vec![0.0; length], vertex: vec![0; length], start: vec![0.0; length + 1] }
    }

    /// Replaces `f` by `min over q of f(q) + (p - q)^2`.
    fn transform(&mut self, f: &mut [f32]) {
        // Beyond a zero nothing is nearer than the zero itself: what lies between two of them is a
        // problem of its own, and zeros stay what they are.
        let mut first = 0;
        while first < f.len() {
            if f[first] == 0.0 {
                first += 1;
                continue;
            }
            let length = f[first..].iter().take_while(|value| **value != 0.0).count();
            let (from, to) = (first.saturating_sub(1), (first + length + 1).min(f.len()));
            self.transform_run(&mut f[from..to]);
            first += length;
        }
    }

    fn transform_run(&mut self, f: &mut [f32]) {
        let input = &mut self.input[..f.len()];
        input.copy_from_slice(f);
        let mut count = 0usize;
        for (q, value) in input.iter().enumerate() {
            if !value.is_finite() {
                continue;
            }
            let height = |at: usize| input[at] + (at * at) as f32;
            let mut from = f32::NEG_INFINITY;
            while count > 0 {
                let last = self.vertex[count - 1];
                from = (height(q) - height(last)) / (2 * (q - last)) as f32;
                if from > self.start[count - 1] {
                    break;
                }
                count -= 1;
            }
            self.vertex[count] = q;
            self.start[count] = if count == 0 { f32::NEG_INFINITY } else { from };
            count += 1;
        }
        if count == 0 {
            return;
        }
        self.start[count] = f32::INFINITY;
        let mut k = 0;
        for (p, out) in f.iter_mut().enumerate() {
            while self.start[k + 1] < p as f32 {
                k += 1;
            }
            let q = self.vertex[k];
            let apart = p.abs_diff(q);
            *out = input[q] + (apart * apart) as f32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use proptest::test_runner::{Config, RngSeed};

    fn config() -> Config {
        let rng_seed = RngSeed::Fixed(7);
        Config { rng_seed, failure_persistence: None, ..Config::default() }
    }

    proptest! {
        #![proptest_config(config())]

        #[test]
        fn agrees_with_trying_every_pixel(
            set in prop::collection::vec(prop::bool::weighted(0.05), 13 * 9),
        ) {
            let (width, height) = (13, 9);
            let found = distance_to(&set, width, height);
            for (at, distance) in found.iter().enumerate() {
                let best = (0..set.len()).filter(|other| set[*other]).map(|other| {
                    let du = (at % width).abs_diff(other % width) as f32;
                    let dv = (at / width).abs_diff(other / width) as f32;
                    (du * du + dv * dv).sqrt()
                });
                let best = best.fold(f32::INFINITY, f32::min);
                prop_assert!(*distance == best || (distance - best).abs() < 1e-4);
            }
        }
    }
}
