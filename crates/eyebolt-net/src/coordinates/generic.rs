//! Maps of any kernel between any two resolutions, by looking every pair up.

use super::kernel_map::{BLOCK_ROWS, KernelMap, MapBlock};
use super::morton;
use super::{Kernel, VoxelSet};
use rayon::prelude::*;

/// The map of a convolution from `fine` voxels to `coarse` ones, `factor` times as large (1: the
/// same voxels): `out(u) = sum over o of W[o] in(u + o)`, `o` in voxels of the finer.
pub fn build(fine: &VoxelSet, coarse: &VoxelSet, kernel: Kernel, factor: u32) -> KernelMap {
    let offsets = kernel.offsets();
    let count = coarse.len().div_ceil(BLOCK_ROWS);
    let blocks = (0..count)
        .into_par_iter()
        .map(|block| {
            let rows = block * BLOCK_ROWS..((block + 1) * BLOCK_ROWS).min(coarse.len());
            let lists: Vec<_> = offsets
                .iter()
                .map(|&offset| pairs_at(fine, coarse, factor, offset, rows.clone()))
                .collect();
            MapBlock::from_lists(lists.iter().map(|(a, b)| (a.as_slice(), b.as_slice())))
        })
        .collect();
    let mirrored = factor == 1 && kernel.size % 2 == 1;
    KernelMap::new(offsets.len(), fine.len(), coarse.len(), mirrored, blocks)
}

fn pairs_at(
    fine: &VoxelSet,
    coarse: &VoxelSet,
    factor: u32,
    offset: [i32; 3],
    rows: std::ops::Range<usize>,
) -> (Vec<u32>, Vec<u16>) {
    let start = rows.start;
    rows.filter_map(|row| {
        let cell = morton::decode(coarse.code(row));
        let input = input_cell(cell, coarse.origin(), fine.origin(), factor, offset)?;
        let found = fine.bricks().row(coarse.item(row), morton::encode(input))?;
        Some((found, (row - start) as u16))
    })
    .unzip()
}

/// The cell of the finer resolution at an offset from the corner of a coarser one, if codes reach
/// that far.
fn input_cell(
    cell: [u32; 3],
    coarse_origin: u32,
    fine_origin: u32,
    factor: u32,
    offset: [i32; 3],
) -> Option<[u32; 3]> {
    let mut input = [0; 3];
    for axis in 0..3 {
        let corner = (i64::from(cell[axis]) - i64::from(coarse_origin)) * i64::from(factor);
        let value = corner + i64::from(offset[axis]) + i64::from(fine_origin);
        input[axis] = u32::try_from(value).ok().filter(|&value| value < 1 << morton::BITS)?;
    }
    Some(input)
}
