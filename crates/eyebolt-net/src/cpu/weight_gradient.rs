//! The gradient of a convolution's weights: for each offset a product of its input rows,
//! transposed, with its output gradients. Every task owns a run of rows of the result and sums its
//! pairs in order.

use super::convolve::Pairs;
use super::panels::panels;
use crate::coordinates::BLOCK_ROWS;
use crate::simd::{Isa, Rows, multiply_transposed};
use rayon::prelude::*;

/// Input channels of a task: a panel of sums for them takes a part of the second-level cache.
const CHANNELS: usize = 128;

/// `dW[o] = sum over pairs (o, i, u) of in(i)^T g(u)`; `out` is overwritten.
pub fn weight_gradient(
    isa: Isa,
    pairs: Pairs<'_>,
    input: Rows<'_>,
    gradient: Rows<'_>,
    out: &mut [f32],
) {
    let (depth, columns) = (input.width, gradient.width);
    if depth == 0 || columns == 0 {
        return;
    }
    let mut tasks: Vec<(usize, usize, &mut [f32])> = Vec::new();
    for (offset, matrix) in out.chunks_mut(depth * columns).enumerate() {
        let parts = matrix.chunks_mut(CHANNELS * columns).enumerate();
        tasks.extend(parts.map(|(part, rows)| (offset, part * CHANNELS, rows)));
    }
    tasks.into_par_iter().with_max_len(1).for_each_init(
        || (Vec::new(), Vec::new()),
        |(gathered, sums), (offset, first, out)| {
            for (column, count, width) in panels(columns) {
                sums.clear();
                sums.resize(out.len() / columns * width, 0.0);
                for block in 0..pairs.outputs().div_ceil(BLOCK_ROWS) {
                    let (from, inputs, outputs) = pairs.get(block, offset);
                    let start = block * BLOCK_ROWS * columns + column;
                    gather(&gradient.values[start..], columns, outputs, count, width, gathered);
                    let a = Rows { values: &input.values[from * depth..], width: depth };
                    let b = Rows { values: gathered, width };
                    multiply_transposed(isa, a, inputs, first, b, sums);
                }
                for (out, sums) in out.chunks_exact_mut(columns).zip(sums.chunks_exact(width)) {
                    out[column..column + count].copy_from_slice(&sums[..count]);
                }
            }
        },
    );
}

/// `count` columns of these rows, padded with zeros to `width`.
fn gather(
    values: &[f32],
    columns: usize,
    rows: &[u16],
    count: usize,
    width: usize,
    gathered: &mut Vec<f32>,
) {
    gathered.clear();
    for &row in rows {
        gathered.extend_from_slice(&values[usize::from(row) * columns..][..count]);
        gathered.resize(gathered.len() + width - count, 0.0);
    }
}
