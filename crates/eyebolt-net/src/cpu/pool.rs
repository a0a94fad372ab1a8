//! Rows from other rows: weighted sums and maxima.

use crate::row_map::{RowMap, Runs};
use rayon::prelude::*;

/// Rows of a task.
const ROWS: usize = 256;
/// Rows that are summed in 32 bits: of more, as a mean over a whole cloud has, rounding would show.
const RUN: usize = 128;

/// Weighted sums of rows.
pub fn combine(map: &RowMap, input: &[f32], channels: usize, out: &mut [f32]) {
    if channels == 0 {
        return;
    }
    out.par_chunks_mut(ROWS * channels).enumerate().for_each(|(chunk, out)| {
        for (row, out) in out.chunks_exact_mut(channels).enumerate() {
            let (rows, weights) = map.lists(chunk * ROWS + row);
            if rows.len() <= RUN {
                sum(rows, weights, input, out);
            } else {
                sum_of_runs(rows, weights, input, out);
            }
        }
    });
}

/// A weighted sum of rows.
fn sum(rows: &[u32], weights: &[f32], input: &[f32], out: &mut [f32]) {
    let channels = out.len();
    out.fill(0.0);
    for (&row, weight) in rows.iter().zip(weights) {
        for (out, &value) in out.iter_mut().zip(&input[row as usize * channels..][..channels]) {
            *out += weight * value;
        }
    }
}

/// A weighted sum of many rows: of runs on all cores, which are added in order in 64 bits.
fn sum_of_runs(rows: &[u32], weights: &[f32], input: &[f32], out: &mut [f32]) {
    let channels = out.len();
    let runs = rows.par_chunks(RUN).zip(weights.par_chunks(RUN));
    let sums: Vec<Vec<f32>> = runs
        .map(|(rows, weights)| {
            let mut part = vec![0.0; channels];
            sum(rows, weights, input, &mut part);
            part
        })
        .collect();
    for (c, out) in out.iter_mut().enumerate() {
        *out = sums.iter().map(|part| f64::from(part[c])).sum::<f64>() as f32;
    }
}

/// Largest of each run.
pub fn max_pool(runs: &Runs, input: &[f32], channels: usize, out: &mut [f32]) {
    if channels == 0 {
        return;
    }
    out.par_chunks_exact_mut(channels).enumerate().with_min_len(16).for_each(|(run, out)| {
        let rows = runs.get(run);
        out.copy_from_slice(&input[rows.start * channels..][..channels]);
        for row in rows.skip(1) {
            for (out, &value) in out.iter_mut().zip(&input[row * channels..][..channels]) {
                *out = if value > *out { value } else { *out };
            }
        }
    });
}

/// Gradients to the row that was largest, the first of equals. `back` is overwritten.
pub fn max_pool_backward(
    runs: &Runs,
    input: &[f32],
    channels: usize,
    gradient: &[f32],
    back: &mut [f32],
) {
    back.fill(0.0);
    let mut rest = back;
    let mut parts = Vec::with_capacity(runs.len());
    for run in runs.iter() {
        let (part, after) = rest.split_at_mut(run.len() * channels);
        parts.push((run, part));
        rest = after;
    }
    parts.into_par_iter().enumerate().with_min_len(16).for_each(|(index, (run, back))| {
        for c in 0..channels {
            let at = |row: usize| input[(run.start + row) * channels + c];
            let mut best = 0;
            for row in 1..run.len() {
                if at(row) > at(best) {
                    best = row;
                }
            }
            back[best * channels + c] = gradient[index * channels + c];
        }
    });
}
