//! The gradient of a convolution's weights: for each offset a product of its input rows,
//! transposed, with its output gradients. Every task owns a run of rows of the result and sums its
//! pairs in order.

use super::convolve::Pairs;
use super::panels::panels;
use crate::coordinates::BLOCK_ROWS;
use crate::simd::{Isa, PANEL, Rows, multiply_transposed};
use rayon::prelude::*;

/// Input channels of a task at most: a panel of sums for them takes a part of the second-level
/// cache.
const CHANNELS: usize = 256;
/// Pairs at a time: enough to pay for fetching sums, few enough that both their rows stay in the
/// second-level cache while all channels pass (96 took 4 % longer).
const PAIRS: usize = 256;

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
    // Parts of equal size, so that none is a small rest.
    let channels = depth.div_ceil(depth.div_ceil(CHANNELS));
    let mut tasks: Vec<(usize, usize, &mut [f32])> = Vec::new();
    for (offset, matrix) in out.chunks_mut(depth * columns).enumerate() {
        let parts = matrix.chunks_mut(channels * columns).enumerate();
        tasks.extend(parts.map(|(part, rows)| (offset, part * channels, rows)));
    }
    tasks.into_par_iter().with_max_len(1).for_each_init(
        || (Vec::new(), Vec::new()),
        |(gathered, sums), (offset, first, out)| {
            for (column, count, width) in panels(columns) {
                sums.clear();
                sums.resize(out.len() / columns * width, 0.0);
                let mut chunks = chunks(pairs, offset).peekable();
                while let Some(Chunk { block, from, inputs, outputs }) = chunks.next() {
                    let start = block * BLOCK_ROWS * columns + column;
                    gather(&gradient.values[start..], columns, outputs, count, width, gathered);
                    let a = Rows { values: &input.values[from * depth..], width: depth };
                    let b = Rows { values: &gathered[..inputs.len() * width], width };
                    // Rows of a kernel map lie where no prefetcher guesses.
                    let next = chunks.peek().filter(|next| next.from == from);
                    let next = next.map_or(&[][..], |next| next.inputs);
                    multiply_transposed(isa, a, inputs, first, b, sums, next);
                }
                for (out, sums) in out.chunks_exact_mut(columns).zip(sums.chunks_exact(width)) {
                    out[column..column + count].copy_from_slice(&sums[..count]);
                }
            }
        },
    );
}

/// Some pairs of an offset.
struct Chunk<'a> {
    block: usize,
    /// The row that inputs count from.
    from: usize,
    inputs: &'a [u32],
    outputs: &'a [u16],
}

fn chunks<'a>(pairs: Pairs<'a>, offset: usize) -> impl Iterator<Item = Chunk<'a>> {
    (0..pairs.outputs().div_ceil(BLOCK_ROWS)).flat_map(move |block| {
        let (from, inputs, outputs) = pairs.get(block, offset);
        let parts = inputs.chunks(PAIRS).zip(outputs.chunks(PAIRS));
        parts.map(move |(inputs, outputs)| Chunk { block, from, inputs, outputs })
    })
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
    gathered.resize(rows.len().max(PAIRS) * width, 0.0);
    for (to, &row) in gathered.chunks_exact_mut(width).zip(rows) {
        let from = &values[usize::from(row) * columns..];
        match (to.as_chunks_mut::<PANEL>(), from.first_chunk::<PANEL>()) {
            // Of known length: without a call.
            (([to], []), Some(from)) if count == PANEL => *to = *from,
            _ => {
                to[..count].copy_from_slice(&from[..count]);
                to[count..].fill(0.0);
            }
        }
    }
}
