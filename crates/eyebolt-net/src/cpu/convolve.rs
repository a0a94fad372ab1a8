//! The convolution, forward and for the gradient of its input: block after block of output rows,
//! panel after panel of channels; sums stay in cache and are written once.

use super::panels::{Panels, panels};
use crate::coordinates::{BLOCK_ROWS, KernelMap};
use crate::simd::{Isa, Rows, multiply_rows};
use rayon::prelude::*;
use std::sync::LazyLock;

/// With fewer blocks than this the panels of each are shared out too.
const FEW_BLOCKS: usize = 16;

/// What happens to sums on their way out: `activation(scale * sum + shift + residual)`.
#[derive(Clone, Copy, Default)]
pub struct Epilogue<'a> {
    /// For each channel.
    pub scale: Option<&'a [f32]>,
    /// For each channel.
    pub shift: Option<&'a [f32]>,
    /// As large as the output.
    pub residual: Option<&'a [f32]>,
    /// Slope of negative values.
    pub slope: Option<f32>,
}

/// Which rows meet: a kernel map, or each row with itself.
#[derive(Clone, Copy)]
pub enum Pairs<'a> {
    /// Of a convolution.
    Map(&'a KernelMap),
    /// Of a linear layer over so many rows.
    Same(usize),
}

static COUNT_U32: LazyLock<Vec<u32>> = LazyLock::new(|| (0..BLOCK_ROWS as u32).collect());
static COUNT_U16: LazyLock<Vec<u16>> = LazyLock::new(|| (0..BLOCK_ROWS as u16).collect());

impl<'a> Pairs<'a> {
    /// Number of offsets.
    pub fn volume(self) -> usize {
        match self {
            Self::Map(map) => map.volume(),
            Self::Same(_) => 1,
        }
    }

    /// Number of output rows.
    pub fn outputs(self) -> usize {
        match self {
            Self::Map(map) => map.outputs(),
            Self::Same(rows) => rows,
        }
    }

    /// Of a block at an offset: the row that inputs count from, inputs, and outputs.
    pub fn get(self, block: usize, offset: usize) -> (usize, &'a [u32], &'a [u16]) {
        match self {
            Self::Map(map) => {
                let (input, output) = map.blocks()[block].pairs(offset);
                (0, input, output)
            }
            Self::Same(rows) => {
                let first = block * BLOCK_ROWS;
                let count = BLOCK_ROWS.min(rows - first);
                (first, &COUNT_U32[..count], &COUNT_U16[..count])
            }
        }
    }
}

/// `out(u) = sum over pairs (o, i, u) of in(i) W[o]`, then the epilogue. `out` is overwritten.
pub fn convolve(
    isa: Isa,
    pairs: Pairs<'_>,
    input: &[f32],
    weights: &Panels<'_>,
    epilogue: Epilogue<'_>,
    out: &mut [f32],
) {
    let columns = weights.columns();
    if columns == 0 {
        return;
    }
    let task = Task { isa, pairs, input, weights, epilogue };
    let blocks = pairs.outputs().div_ceil(BLOCK_ROWS);
    if blocks >= FEW_BLOCKS {
        let chunks = out.par_chunks_mut(BLOCK_ROWS * columns).enumerate();
        chunks.for_each_init(Vec::new, |sums, (block, out)| {
            for panel in panels(columns) {
                task.sum(block, panel, sums);
                task.write(block, panel, sums, out);
            }
        });
        return;
    }
    let places: Vec<_> =
        (0..blocks).flat_map(|block| panels(columns).map(move |panel| (block, panel))).collect();
    let parts: Vec<Vec<f32>> = places
        .par_iter()
        .with_max_len(1)
        .map(|&(block, panel)| {
            let mut sums = Vec::new();
            task.sum(block, panel, &mut sums);
            sums
        })
        .collect();
    for ((block, panel), sums) in places.into_iter().zip(parts) {
        let rest = &mut out[block * BLOCK_ROWS * columns..];
        let end = rest.len().min(BLOCK_ROWS * columns);
        task.write(block, panel, &sums, &mut rest[..end]);
    }
}

struct Task<'a> {
    isa: Isa,
    pairs: Pairs<'a>,
    input: &'a [f32],
    weights: &'a Panels<'a>,
    epilogue: Epilogue<'a>,
}

impl Task<'_> {
    /// Sums of a block's rows, for the columns of a panel.
    fn sum(&self, block: usize, (first, _, width): (usize, usize, usize), sums: &mut Vec<f32>) {
        let rows = BLOCK_ROWS.min(self.pairs.outputs() - block * BLOCK_ROWS);
        sums.clear();
        sums.resize(rows * width, 0.0);
        let depth = self.weights.depth();
        for offset in 0..self.pairs.volume() {
            let (from, input, output) = self.pairs.get(block, offset);
            let a = Rows { values: &self.input[from * depth..], width: depth };
            multiply_rows(self.isa, a, input, self.weights.panel(offset, first), sums, output);
        }
    }

    /// Sums to their columns of a block's rows, through the epilogue.
    fn write(
        &self,
        block: usize,
        (first, count, width): (usize, usize, usize),
        sums: &[f32],
        out: &mut [f32],
    ) {
        let columns = self.weights.columns();
        let range = first..first + count;
        let Epilogue { scale, shift, residual, slope } = self.epilogue;
        let scale = scale.map(|scale| &scale[range.clone()]);
        let shift = shift.map(|shift| &shift[range.clone()]);
        let rows = out.chunks_exact_mut(columns).zip(sums.chunks_exact(width)).enumerate();
        for (row, (out, sums)) in rows {
            let out = &mut out[range.clone()];
            let sums = &sums[..count];
            match (scale, shift) {
                (Some(scale), Some(shift)) => {
                    let factors = scale.iter().zip(shift);
                    for ((out, sum), (scale, shift)) in out.iter_mut().zip(sums).zip(factors) {
                        *out = sum * scale + shift;
                    }
                }
                (None, Some(shift)) => {
                    for ((out, sum), shift) in out.iter_mut().zip(sums).zip(shift) {
                        *out = sum + shift;
                    }
                }
                _ => out.copy_from_slice(sums),
            }
            if let Some(residual) = residual {
                let start = (block * BLOCK_ROWS + row) * columns + first;
                for (out, other) in out.iter_mut().zip(&residual[start..start + count]) {
                    *out += other;
                }
            }
            if let Some(slope) = slope {
                for out in out {
                    *out = if *out > 0.0 { *out } else { *out * slope };
                }
            }
        }
    }
}
