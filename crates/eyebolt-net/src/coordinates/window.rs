//! Maps between voxels of one resolution, by a dense window around each brick.

use super::bricks::Brick;
use super::kernel_map::{BLOCK_ROWS, KernelMap, MapBlock};
use super::morton;
use super::{Kernel, VoxelSet};
use rayon::prelude::*;

/// Edge of a brick.
const BRICK: usize = 4;
/// Edge of a window: a brick and its neighbours.
const WINDOW: usize = 3 * BRICK;
/// In a window, a voxel that is not occupied.
const NONE: u32 = u32::MAX;

/// Whether [`build`] can do this kernel: it must not reach past a neighbouring brick.
pub fn fits(kernel: Kernel) -> bool {
    kernel.reach() as usize <= BRICK
}

/// The map of a kernel from a set of voxels to itself.
pub fn build(voxels: &VoxelSet, kernel: Kernel) -> KernelMap {
    let deltas: Vec<isize> = kernel.offsets().iter().map(|&[x, y, z]| delta(x, y, z)).collect();
    let count = voxels.len().div_ceil(BLOCK_ROWS);
    let blocks = (0..count)
        .into_par_iter()
        .map_init(
            || Scratch::new(deltas.len()),
            |scratch, block| scratch.block(voxels, &deltas, block * BLOCK_ROWS),
        )
        .collect();
    let mirrored = kernel.size % 2 == 1;
    KernelMap::new(deltas.len(), voxels.len(), voxels.len(), mirrored, blocks)
}

fn delta(x: i32, y: i32, z: i32) -> isize {
    let window = WINDOW as isize;
    (x as isize * window + y as isize) * window + z as isize
}

/// What one thread works with.
struct Scratch {
    /// Rows of the voxels around a brick.
    window: Vec<u32>,
    /// Lists by offset, each with room for a block; and one pair more, where a pair that is no
    /// pair is written.
    input: Vec<u32>,
    output: Vec<u16>,
    counts: Vec<usize>,
}

impl Scratch {
    fn new(volume: usize) -> Self {
        Self {
            window: vec![NONE; WINDOW.pow(3)],
            input: vec![0; volume * BLOCK_ROWS + 1],
            output: vec![0; volume * BLOCK_ROWS + 1],
            counts: vec![0; volume],
        }
    }

    fn block(&mut self, voxels: &VoxelSet, deltas: &[isize], first: usize) -> MapBlock {
        let end = (first + BLOCK_ROWS).min(voxels.len());
        self.counts.fill(0);
        let bricks = voxels.bricks().list();
        let start = bricks.partition_point(|brick| brick.first as usize <= first) - 1;
        for brick in bricks[start..].iter().take_while(|brick| (brick.first as usize) < end) {
            self.fill_window(voxels, brick);
            for (row, bit) in (brick.first as usize..).zip(bits(brick.occupied)) {
                if (first..end).contains(&row) {
                    self.look_around(place(bit), deltas, row - first);
                }
            }
        }
        let lists = self.counts.iter().enumerate().map(|(offset, &count)| {
            let range = offset * BLOCK_ROWS..offset * BLOCK_ROWS + count;
            (&self.input[range.clone()], &self.output[range])
        });
        MapBlock::from_lists(lists)
    }

    fn look_around(&mut self, place: isize, deltas: &[isize], local: usize) {
        let lists = deltas.iter().zip(&mut self.counts).enumerate();
        for (offset, (&delta, count)) in lists {
            let found = self.window[(place + delta) as usize];
            // Without a branch, which nothing could predict: what is not there is overwritten.
            let at = offset * BLOCK_ROWS + *count;
            self.input[at] = found;
            self.output[at] = local as u16;
            *count += usize::from(found != NONE);
        }
    }

    fn fill_window(&mut self, voxels: &VoxelSet, brick: &Brick) {
        self.window.fill(NONE);
        let (item, code) = brick.place();
        let [x, y, z] = morton::decode(code).map(|value| value as i32);
        for (dx, dy, dz) in around() {
            let cell = [x + dx, y + dy, z + dz];
            // Beyond the last brick nothing is; a code would wrap around.
            if cell.iter().any(|value| !(0..1 << (morton::BITS - 2)).contains(value)) {
                continue;
            }
            let code = morton::encode(cell.map(|value| value as u32));
            let Some(neighbour) = voxels.bricks().find(item, code) else { continue };
            let corner = delta(dx, dy, dz) * BRICK as isize;
            for (row, bit) in (neighbour.first..).zip(bits(neighbour.occupied)) {
                self.window[(place(bit) + corner) as usize] = row;
            }
        }
    }
}

fn around() -> impl Iterator<Item = (i32, i32, i32)> {
    let steps = || -1..=1;
    steps().flat_map(move |x| steps().flat_map(move |y| steps().map(move |z| (x, y, z))))
}

/// Where in the window a voxel of the middle brick lies.
fn place(bit: u32) -> isize {
    let [x, y, z] = morton::decode(bit.into()).map(|value| value as i32 + BRICK as i32);
    delta(x, y, z)
}

/// Places of the bits that are set.
fn bits(mut word: u64) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        let bit = (word != 0).then(|| word.trailing_zeros());
        word &= word.wrapping_sub(1);
        bit
    })
}
