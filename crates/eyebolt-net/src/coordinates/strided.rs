//! The map of a strided convolution whose kernel is as wide as its stride, as in MinkUNet: every
//! voxel meets its parent, once.

use super::kernel_map::{BLOCK_ROWS, KernelMap, MapBlock};
use super::morton;
use super::{Kernel, VoxelSet};

/// Whether [`build`] can do this kernel.
pub fn fits(kernel: Kernel, factor: u32) -> bool {
    kernel.dilation == 1 && kernel.size == factor && factor.is_multiple_of(2)
}

/// The map from `fine` voxels to their `coarse` ones, `parents`.
pub fn build(fine: &VoxelSet, coarse: &VoxelSet, parents: &[u32], kernel: Kernel) -> KernelMap {
    let (factor, volume) = (kernel.size, kernel.volume());
    let count = coarse.len().div_ceil(BLOCK_ROWS);
    let mut lists = vec![vec![(Vec::new(), Vec::new()); volume]; count];
    for (row, &parent) in parents.iter().enumerate() {
        let [x, y, z] = morton::decode(fine.code(row)).map(|value| {
            let cell = i64::from(value) - i64::from(fine.origin());
            cell.rem_euclid(factor.into()) as usize
        });
        if kernel.flat && z > 0 {
            continue;
        }
        let column = x * factor as usize + y;
        let offset = if kernel.flat { column } else { column * factor as usize + z };
        let (inputs, outputs) = &mut lists[parent as usize / BLOCK_ROWS][offset];
        inputs.push(row as u32);
        outputs.push((parent as usize % BLOCK_ROWS) as u16);
    }
    let blocks = lists
        .iter()
        .map(|lists| MapBlock::from_lists(lists.iter().map(|(a, b)| (a.as_slice(), b.as_slice()))))
        .collect();
    KernelMap::new(volume, fine.len(), coarse.len(), false, blocks)
}
