//! Weights cut into panels of columns, as the inner loops read them.

use crate::simd::{PANEL, PANEL_STEP, Rows};
use rayon::prelude::*;

/// First column, columns, and columns with padding of every panel of a matrix so wide.
pub fn panels(columns: usize) -> impl Iterator<Item = (usize, usize, usize)> {
    (0..columns).step_by(PANEL).map(move |first| {
        let count = PANEL.min(columns - first);
        (first, count, count.next_multiple_of(PANEL_STEP))
    })
}

/// Columns with padding of all panels.
pub fn padded(columns: usize) -> usize {
    columns.next_multiple_of(PANEL_STEP)
}

/// One matrix for every offset, cut into panels; the padding is zero.
pub struct Panels<'a> {
    values: &'a [f32],
    depth: usize,
    columns: usize,
}

impl<'a> Panels<'a> {
    /// Length of the buffer that holds them.
    pub fn len(volume: usize, depth: usize, columns: usize) -> usize {
        volume * depth * padded(columns)
    }

    /// Of `[volume, depth, columns]` weights.
    pub fn pack(buffer: &'a mut [f32], weights: &[f32], depth: usize, columns: usize) -> Self {
        // One at least, since chunks of nothing are none: of no channels there is nothing to pack.
        let (size, packed) = ((depth * columns).max(1), (depth * padded(columns)).max(1));
        buffer.par_chunks_exact_mut(packed).zip(weights.par_chunks_exact(size)).for_each(
            |(buffer, matrix)| {
                for (first, count, width) in panels(columns) {
                    let panel = &mut buffer[first * depth..][..width * depth];
                    let rows = panel.chunks_exact_mut(width).zip(matrix.chunks_exact(columns));
                    for (to, from) in rows {
                        to[..count].copy_from_slice(&from[first..first + count]);
                        to[count..].fill(0.0);
                    }
                }
            },
        );
        Self { values: buffer, depth, columns }
    }

    /// Of `[volume, columns, depth]` weights, each matrix transposed; with the offsets in reverse
    /// order if `mirrored`.
    pub fn pack_transposed(
        buffer: &'a mut [f32],
        weights: &[f32],
        depth: usize,
        columns: usize,
        mirrored: bool,
    ) -> Self {
        let (size, packed) = ((depth * columns).max(1), (depth * padded(columns)).max(1));
        let volume = weights.len() / size;
        buffer.par_chunks_exact_mut(packed).enumerate().for_each(|(place, buffer)| {
            let offset = if mirrored { volume - 1 - place } else { place };
            let matrix = &weights[offset * size..][..size];
            for (first, count, width) in panels(columns) {
                let panel = &mut buffer[first * depth..][..width * depth];
                if count < width {
                    panel.fill(0.0);
                }
                transpose(&matrix[first * depth..][..count * depth], depth, panel, width);
            }
        });
        Self { values: buffer, depth, columns }
    }

    /// The panel of an offset that starts at a column.
    pub fn panel(&self, offset: usize, first: usize) -> Rows<'a> {
        let width = padded(self.columns - first).min(PANEL);
        let start = offset * self.depth * padded(self.columns) + first * self.depth;
        Rows { values: &self.values[start..start + self.depth * width], width }
    }

    /// Rows of each panel.
    pub fn depth(&self) -> usize {
        self.depth
    }

    /// Columns of all panels together, without padding.
    pub fn columns(&self) -> usize {
        self.columns
    }
}

/// `to[k][n] = from[n][k]`, in squares that stay in the first-level cache.
fn transpose(from: &[f32], depth: usize, to: &mut [f32], width: usize) {
    const SQUARE: usize = 16;
    for k in (0..depth).step_by(SQUARE) {
        let ks = SQUARE.min(depth - k);
        for (n, row) in from.chunks_exact(depth).enumerate() {
            for (i, &value) in row[k..k + ks].iter().enumerate() {
                to[(k + i) * width + n] = value;
            }
        }
    }
}
