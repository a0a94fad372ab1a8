//! Batch norm in training.

use rayon::prelude::*;

/// Rows of a task: with the widest channels they stay in the second-level cache.
const ROWS: usize = 256;

/// Mean and biased variance of every channel: of chunks first, which are then merged in order
/// (Chan, Golub and LeVeque, *Updating formulae and a pairwise algorithm for computing sample
/// variances*, 1979).
pub fn moments(values: &[f32], channels: usize) -> (Vec<f64>, Vec<f64>) {
    let chunks: Vec<(usize, Vec<f64>, Vec<f64>)> = values
        .par_chunks(ROWS * channels.max(1))
        .map(|chunk| {
            let rows = chunk.len() / channels.max(1);
            let mut mean = column_sums(chunk, channels, |_, value| value);
            mean.iter_mut().for_each(|sum| *sum /= rows as f32);
            let spread = column_sums(chunk, channels, |c, value| {
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

fn column_sums(chunk: &[f32], channels: usize, of: impl Fn(usize, f32) -> f32) -> Vec<f32> {
    let mut sums = vec![0.0; channels];
    for row in chunk.chunks_exact(channels.max(1)) {
        for c in 0..channels {
            sums[c] += of(c, row[c]);
        }
    }
    sums
}

/// Sums over all rows of the gradient, and of the gradient times the normalised input.
pub fn gradient_sums(
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

/// The gradient of the input, in place of that of the output: `factor (g - a - (x - mean) b)`.
pub fn backward(
    gradient: &mut [f32],
    input: &[f32],
    mean: &[f32],
    factor: &[f32],
    a: &[f32],
    b: &[f32],
) {
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
}
