//! Noise that neighbours share.

use crate::random::Random;
use rayon::prelude::*;

/// A random function of the image with mean 0, variance 1 everywhere, and no seams.
///
/// Independent normal numbers at the nodes of a lattice, weighted by quadratic B-splines (Unser,
/// *Splines: a perfect fit for signal and image processing*, IEEE Signal Processing Magazine,
/// 1999) and divided by the norm of the weights, so that no place has less variance
/// than another.
#[derive(Clone, Debug)]
pub struct Field {
    columns: usize,
    nodes: Vec<f32>,
    /// Of each column and each row of the image, the first node and the weights.
    across: Vec<(usize, [f32; 3])>,
    down: Vec<(usize, [f32; 3])>,
}

/// Lag at which the correlation of a [`Field`] is one half, in spacings of its lattice; from the
/// autocorrelation of the weights, the B-spline of degree 5.
const HALF_CORRELATION: f32 = 0.87;

impl Field {
    /// The field of `random` over an image of `size` (width, height), with correlation one half
    /// between pixels that are `half_px` apart.
    pub fn new(random: Random, size: [usize; 2], half_px: f32) -> Self {
        let per_px = HALF_CORRELATION / half_px;
        let [columns, rows] = size.map(|pixels| (pixels as f32 * per_px) as usize + 4);
        // The lattice would show if it lay in the same place in every frame.
        let mut place = random.at(u64::MAX);
        let [across, down] = size.map(|pixels| {
            let shift = place.uniform() as f32;
            (0..pixels).map(|pixel| weights(pixel as f32 * per_px + shift)).collect()
        });
        let count = (columns * rows) as u64;
        let nodes = (0..count).map(|node| random.at(node).normal() as f32).collect();
        Self { columns, nodes, across, down }
    }

    /// The value at pixel `(u, v)` of the image.
    pub fn at(&self, u: usize, v: usize) -> f32 {
        let (first_column, across) = self.across[u];
        let (first_row, down) = self.down[v];
        let mut sum = 0.0;
        for (row, weight) in (first_row..).zip(down) {
            let at = row * self.columns + first_column;
            let [a, b, c] = [0, 1, 2].map(|k| self.nodes[at + k]);
            sum += weight * (across[0] * a + across[1] * b + across[2] * c);
        }
        sum
    }
}

/// First of three nodes and their weights at `x >= 0` of a lattice with spacing 1 that begins half
/// a spacing before 0.
fn weights(x: f32) -> (usize, [f32; 3]) {
    let first = x as usize;
    let t = x - first as f32 - 0.5;
    let (below, above) = (0.5 - t, 0.5 + t);
    let weights = [0.5 * below * below, 0.75 - t * t, 0.5 * above * above];
    let norm = weights.iter().map(|w| w * w).sum::<f32>().sqrt();
    (first, weights.map(|w| w / norm))
}

/// A random function of the image and a third coordinate, depth or disparity, with mean 0 and
/// variance 1.
///
/// What a camera gets wrong in the same way again and again depends on where it looks and on how
/// far away what is there is: a wall keeps its error while an arm moves before it.
#[derive(Debug)]
pub struct Layers {
    first: usize,
    fields: Vec<Field>,
    per_unit: f32,
}

/// More than any camera's range has: 200 for a RealSense D455 at its nearest.
const MOST_LAYERS: usize = 600;

impl Layers {
    /// The layers of `random` for third coordinates from 0 to those of `values`, with correlation
    /// one half between places that are `half_px` apart in the image, or `half_depth` in the third
    /// coordinate.
    pub fn new(
        random: Random,
        size: [usize; 2],
        half_px: f32,
        half_depth: f32,
        values: &[f32],
    ) -> Self {
        let per_unit = HALF_CORRELATION / half_depth;
        let used = || values.iter().copied().filter(|value| *value > 0.0 && value.is_finite());
        let least = used().fold(f32::INFINITY, f32::min);
        let first = if least.is_finite() { (least * per_unit) as usize } else { 0 };
        let last = (used().fold(0.0, f32::max) * per_unit) as usize;
        // Disparity grows without bound toward the lens.
        let last = last.clamp(first, first + MOST_LAYERS) + 3;
        let layers = (first..last).into_par_iter();
        let field = |layer: usize| Field::new(random.at(layer as u64), size, half_px);
        Self { first, fields: layers.map(field).collect(), per_unit }
    }

    /// The value at pixel `(u, v)` and `depth`, one of those the layers were made for; beyond
    /// them, that of the last.
    pub fn at(&self, u: usize, v: usize, depth: f32) -> f32 {
        let end = (self.first + self.fields.len() - 2) as f32;
        let (first, weights) = weights((depth * self.per_unit).min(end.next_down()));
        let layers = self.fields[first - self.first..].iter();
        layers.zip(weights).map(|(field, weight)| weight * field.at(u, v)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [usize; 2] = [200, 150];

    /// Mean product of the values of many fields at pairs of places `lag` apart along each axis.
    fn correlation(half_px: f32, lag: usize) -> f32 {
        let mut sum = 0.0;
        let mut count = 0.0;
        for seed in 0..40 {
            let field = Field::new(Random::new(seed), SIZE, half_px);
            for v in 0..SIZE[1] - lag {
                for u in 0..SIZE[0] - lag {
                    let here = field.at(u, v);
                    sum += here * (field.at(u + lag, v) + field.at(u, v + lag));
                    count += 2.0;
                }
            }
        }
        sum / count
    }

    #[test]
    fn half_of_the_correlation_at_the_lag_asked_for() {
        for half_px in [2.0, 5.0] {
            let lag = half_px as usize;
            assert!((correlation(half_px, 0) - 1.0).abs() < 0.03, "{}", correlation(half_px, 0));
            assert!(
                (correlation(half_px, lag) - 0.5).abs() < 0.03,
                "{}",
                correlation(half_px, lag)
            );
            assert!(correlation(half_px, 4 * lag).abs() < 0.03);
        }
    }

    #[test]
    fn no_place_has_less_variance_than_another() {
        // Wherever between the nodes: with the lattice in one place, weights vary by a factor of 2.
        for x in [0.0, 0.25, 0.5, 0.8] {
            let (_, weights) = weights(x);
            let variance: f32 = weights.iter().map(|w| w * w).sum();
            assert!((variance - 1.0).abs() < 1e-6, "{x}: {variance}");
        }
    }

    #[test]
    fn disparities_without_bound_take_no_memory_without_bound() {
        let layers = Layers::new(Random::new(1), [40, 40], 5.0, 2.0, &[3.0, 1e30]);
        assert!(layers.fields.len() <= MOST_LAYERS + 3);
        assert!(layers.at(3, 4, 1e30).is_finite() && layers.at(3, 4, 3.0).is_finite());
    }

    #[test]
    fn layers_change_with_depth() {
        let values = [3.0, 40.0];
        let (mut same, mut near, mut far) = (0.0, 0.0, 0.0);
        for seed in 0..300 {
            let layers = Layers::new(Random::new(seed), [40, 40], 5.0, 2.0, &values);
            for (u, v) in [(0, 0), (20, 0), (0, 20), (39, 39)] {
                let here = layers.at(u, v, 20.0);
                same += here * here / 1200.0;
                near += here * layers.at(u, v, 22.0) / 1200.0;
                far += here * layers.at(u, v, 30.0) / 1200.0;
            }
        }
        assert!((same - 1.0).abs() < 0.15, "{same}");
        assert!((near - 0.5).abs() < 0.15, "{near}");
        assert!(far.abs() < 0.1, "{far}");
    }
}
