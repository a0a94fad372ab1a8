//! Operations value by value. They wait for memory, not for arithmetic: the compiler's loops do.

use crate::executor::dropout_keeps;
use rayon::prelude::*;

/// Values of a task.
const CHUNK: usize = 1 << 16;

/// `x` where positive, else `slope * x`.
pub fn activate(values: &mut [f32], slope: f32) {
    values.par_chunks_mut(CHUNK).for_each(|values| {
        for value in values {
            *value = if *value > 0.0 { *value } else { *value * slope };
        }
    });
}

/// Gradients through an activation, by the sign of what came out of it.
pub fn activate_backward(gradient: &mut [f32], output: &[f32], slope: f32) {
    gradient.par_chunks_mut(CHUNK).zip(output.par_chunks(CHUNK)).for_each(|(gradient, output)| {
        for (gradient, &output) in gradient.iter_mut().zip(output) {
            *gradient = if output > 0.0 { *gradient } else { *gradient * slope };
        }
    });
}

/// Sum of two.
pub fn add(left: &[f32], right: &[f32], out: &mut [f32]) {
    let parts = left.par_chunks(CHUNK).zip(right.par_chunks(CHUNK));
    out.par_chunks_mut(CHUNK).zip(parts).for_each(|(out, (left, right))| {
        for ((out, left), right) in out.iter_mut().zip(left).zip(right) {
            *out = left + right;
        }
    });
}

/// Adds to what is there.
pub fn add_to(sum: &mut [f32], other: &[f32]) {
    sum.par_chunks_mut(CHUNK).zip(other.par_chunks(CHUNK)).for_each(|(sum, other)| {
        for (sum, other) in sum.iter_mut().zip(other) {
            *sum += other;
        }
    });
}

/// `scale * x + shift` channel by channel.
pub fn scale_shift(input: &[f32], scale: &[f32], shift: &[f32], out: &mut [f32]) {
    let channels = scale.len();
    if channels == 0 {
        return;
    }
    let chunk = (CHUNK / channels).max(1) * channels;
    out.par_chunks_mut(chunk).zip(input.par_chunks(chunk)).for_each(|(out, input)| {
        for (out, input) in out.chunks_exact_mut(channels).zip(input.chunks_exact(channels)) {
            for c in 0..channels {
                out[c] = input[c] * scale[c] + shift[c];
            }
        }
    });
}

/// Channels of several side by side, each with its number of channels.
pub fn concatenate(parts: &[(&[f32], usize)], out: &mut [f32]) {
    let channels: usize = parts.iter().map(|(_, channels)| channels).sum();
    if channels == 0 {
        return;
    }
    let rows = (CHUNK / channels).max(1);
    out.par_chunks_mut(rows * channels).enumerate().for_each(|(chunk, out)| {
        for (row, out) in out.chunks_exact_mut(channels).enumerate() {
            let row = chunk * rows + row;
            let mut start = 0;
            for &(values, width) in parts {
                out[start..start + width].copy_from_slice(&values[row * width..][..width]);
                start += width;
            }
        }
    });
}

/// Some channels of every row, from `start` on.
pub fn columns(values: &[f32], channels: usize, start: usize, width: usize, out: &mut [f32]) {
    if width == 0 {
        return;
    }
    let rows = (CHUNK / width).max(1);
    out.par_chunks_mut(rows * width).enumerate().for_each(|(chunk, out)| {
        for (row, out) in out.chunks_exact_mut(width).enumerate() {
            let from = (chunk * rows + row) * channels + start;
            out.copy_from_slice(&values[from..from + width]);
        }
    });
}

/// Dropout, forward and backward alike.
pub fn dropout(values: &mut [f32], seed: u64, node: usize, probability: f32) {
    let scale = 1.0 / (1.0 - probability);
    values.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, values)| {
        for (at, value) in values.iter_mut().enumerate() {
            let keeps = dropout_keeps(seed, node, chunk * CHUNK + at, probability);
            *value = if keeps { *value * scale } else { 0.0 };
        }
    });
}
