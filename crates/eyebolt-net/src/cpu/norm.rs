//! Batch norm in training.

use super::elementwise;
use crate::Parameters;
use crate::graph::{BatchNorm, ParameterId};
use rayon::prelude::*;

/// Rows of a task: with the widest channels they stay in the second-level cache.
const ROWS: usize = 256;

/// Mean and inverse deviation of a batch norm's channels.
pub struct Moments {
    pub mean: Vec<f32>,
    pub inverse: Vec<f32>,
}

/// Normalises by the moments of the batch, which are also blended into the running ones.
pub fn forward(
    op: &BatchNorm,
    parameters: &Parameters,
    input: &[f32],
    out: &mut [f32],
    running: &mut Vec<(ParameterId, Vec<f32>)>,
) -> Moments {
    let (scale, shift) = (parameters.get(op.scale), parameters.get(op.shift));
    let channels = scale.len();
    let rows = (input.len() / channels.max(1)) as f64;
    let (mean, variance) = moments(input, channels);
    let inverse = |&value: &f64| (1.0 / (value + f64::from(op.epsilon)).sqrt()) as f32;
    let inverse: Vec<f32> = variance.iter().map(inverse).collect();
    let scale: Vec<f32> = scale.iter().zip(&inverse).map(|(a, b)| a * b).collect();
    let shift: Vec<f32> = (0..channels)
        .map(|c| (f64::from(shift[c]) - mean[c] * f64::from(scale[c])) as f32)
        .collect();
    elementwise::scale_shift(input, &scale, &shift, out);
    let blend = |old: ParameterId, new: &[f64], correction: f64| {
        let share = f64::from(op.momentum);
        let pairs = parameters.get(old).iter().zip(new);
        let blend = |(&old, &new): (&f32, &f64)| {
            (f64::from(old) * (1.0 - share) + new * correction * share) as f32
        };
        (old, pairs.map(blend).collect())
    };
    running.push(blend(op.mean, &mean, 1.0));
    running.push(blend(op.variance, &variance, rows / (rows - 1.0)));
    Moments { mean: mean.into_iter().map(|value| value as f32).collect(), inverse }
}

/// Mean and biased variance of every channel: of chunks first, which are then merged in order
/// (Chan, Golub and LeVeque, *Updating formulae and a pairwise algorithm for computing sample
/// variances*, 1979).
fn moments(values: &[f32], channels: usize) -> (Vec<f64>, Vec<f64>) {
    let chunks: Vec<(usize, Vec<f64>, Vec<f64>)> = values
        .par_chunks(ROWS * channels.max(1))
        .map(|chunk| {
            let rows = chunk.len() / channels.max(1);
            let mut mean = chunk_sums(chunk, channels, |_, value| value);
            mean.iter_mut().for_each(|sum| *sum /= rows as f32);
            let spread = chunk_sums(chunk, channels, |c, value| {
                let difference = value - mean[c];
                difference * difference
            });
            let wide = |values: Vec<f32>| values.into_iter().map(f64::from).collect();
            (rows, wide(mean), wide(spread))
        })
        .collect();
    let (mut count, mut mean, mut spread) = (0.0, vec![0.0; channels], vec![0.0; channels]);
    for (rows, chunk_mean, chunk_spread) in chunks {
        let rows = rows as f64;
        let total = count + rows;
        for c in 0..channels {
            let difference: f64 = chunk_mean[c] - mean[c];
            mean[c] += difference * rows / total;
            spread[c] += chunk_spread[c] + difference * difference * count * rows / total;
        }
        count = total;
    }
    spread.iter_mut().for_each(|spread| *spread /= f64::max(count, 1.0));
    (mean, spread)
}

fn chunk_sums(chunk: &[f32], channels: usize, of: impl Fn(usize, f32) -> f32) -> Vec<f32> {
    let mut sums = vec![0.0; channels];
    for row in chunk.chunks_exact(channels.max(1)) {
        for c in 0..channels {
            sums[c] += of(c, row[c]);
        }
    }
    sums
}

/// Sums over all rows.
pub fn column_sums(values: &[f32], channels: usize) -> Vec<f32> {
    let zeros = vec![0.0; channels];
    gradient_sums(values, values, &zeros, &zeros).0
}

/// Sums over all rows of the gradient, and of the gradient times the normalised input.
fn gradient_sums(
    gradient: &[f32],
    input: &[f32],
    mean: &[f32],
    inverse: &[f32],
) -> (Vec<f32>, Vec<f32>) {
    let channels = mean.len();
    let chunk = ROWS * channels.max(1);
    let sums: Vec<(Vec<f32>, Vec<f32>)> = gradient
        .par_chunks(chunk)
        .zip(input.par_chunks(chunk))
        .map(|(gradient, input)| {
            let (mut plain, mut weighted) = (vec![0.0; channels], vec![0.0; channels]);
            let rows = gradient.chunks_exact(channels).zip(input.chunks_exact(channels));
            for (gradient, input) in rows {
                for c in 0..channels {
                    plain[c] += gradient[c];
                    weighted[c] += gradient[c] * (input[c] - mean[c]);
                }
            }
            (plain, weighted)
        })
        .collect();
    let (mut plain, mut weighted) = (vec![0.0_f64; channels], vec![0.0_f64; channels]);
    for (chunk_plain, chunk_weighted) in sums {
        for c in 0..channels {
            plain[c] += f64::from(chunk_plain[c]);
            weighted[c] += f64::from(chunk_weighted[c]) * f64::from(inverse[c]);
        }
    }
    let narrow = |values: Vec<f64>| values.into_iter().map(|value| value as f32).collect();
    (narrow(plain), narrow(weighted))
}

/// The gradient of the input, in place of that of the output; those of scale and shift are
/// returned.
pub fn backward(
    scale: &[f32],
    moments: &Moments,
    input: &[f32],
    gradient: &mut [f32],
) -> (Vec<f32>, Vec<f32>) {
    let Moments { mean, inverse } = moments;
    let (of_shift, of_scale) = gradient_sums(gradient, input, mean, inverse);
    let count = (gradient.len() / mean.len().max(1)) as f32;
    let factor: Vec<f32> = scale.iter().zip(inverse).map(|(a, b)| a * b).collect();
    let a: Vec<f32> = of_shift.iter().map(|sum| sum / count).collect();
    let sums = of_scale.iter().zip(inverse);
    let b: Vec<f32> = sums.map(|(sum, inverse)| sum / count * inverse).collect();
    let channels = mean.len();
    let chunk = ROWS * channels.max(1);
    gradient.par_chunks_mut(chunk).zip(input.par_chunks(chunk)).for_each(|(gradient, input)| {
        let rows = gradient.chunks_exact_mut(channels).zip(input.chunks_exact(channels));
        for (gradient, input) in rows {
            for c in 0..channels {
                gradient[c] = factor[c] * (gradient[c] - a[c] - (input[c] - mean[c]) * b[c]);
            }
        }
    });
    (of_scale, of_shift)
}
