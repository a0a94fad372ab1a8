//! Which input voxel meets which weight at which output voxel.

use rayon::prelude::*;
use std::sync::OnceLock;

/// Output rows of a block: enough that a block's use of a weight pays for fetching it, few enough
/// that the block's sums stay in the second-level cache.
pub const BLOCK_ROWS: usize = 512;

/// The pairs of a run of [`BLOCK_ROWS`] output rows, offset after offset.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MapBlock {
    starts: Vec<u32>,
    input: Vec<u32>,
    output: Vec<u16>,
}

impl MapBlock {
    /// Input rows and, counted from the block's first, output rows that meet at this offset.
    pub fn pairs(&self, offset: usize) -> (&[u32], &[u16]) {
        let range = self.starts[offset] as usize..self.starts[offset + 1] as usize;
        (&self.input[range.clone()], &self.output[range])
    }

    /// From lists by offset.
    pub(super) fn from_lists<'a>(
        lists: impl Iterator<Item = (&'a [u32], &'a [u16])> + Clone,
    ) -> Self {
        let total = lists.clone().map(|(input, _)| input.len()).sum();
        let mut block = Self {
            starts: vec![0],
            input: Vec::with_capacity(total),
            output: Vec::with_capacity(total),
        };
        for (input, output) in lists {
            block.input.extend_from_slice(input);
            block.output.extend_from_slice(output);
            block.starts.push(block.input.len() as u32);
        }
        block
    }
}

/// A convolution's pairs of voxels, built once and shared by all layers between the same
/// resolutions with the same kernel.
#[derive(Debug)]
pub struct KernelMap {
    volume: usize,
    inputs: usize,
    outputs: usize,
    /// Around the voxel, between voxels of one set: the map of the reverse pass is this one with
    /// its offsets in reverse order.
    mirrored: bool,
    blocks: Vec<MapBlock>,
    adjoint: OnceLock<Box<KernelMap>>,
}

impl KernelMap {
    pub(super) fn new(
        volume: usize,
        inputs: usize,
        outputs: usize,
        mirrored: bool,
        blocks: Vec<MapBlock>,
    ) -> Self {
        debug_assert_eq!(blocks.len(), outputs.div_ceil(BLOCK_ROWS));
        Self { volume, inputs, outputs, mirrored, blocks, adjoint: OnceLock::new() }
    }

    /// Number of offsets.
    pub fn volume(&self) -> usize {
        self.volume
    }

    /// Number of input rows.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// Number of output rows.
    pub fn outputs(&self) -> usize {
        self.outputs
    }

    /// One for each run of [`BLOCK_ROWS`] output rows.
    pub fn blocks(&self) -> &[MapBlock] {
        &self.blocks
    }

    /// Input and output rows that meet at an offset of the kernel, each output at most once: the map
    /// without its blocks.
    pub fn pairs_at(&self, offset: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.blocks.iter().enumerate().flat_map(move |(index, block)| {
            let (input, output) = block.pairs(offset);
            let first = index * BLOCK_ROWS;
            let outputs = output.iter().map(move |&output| first + usize::from(output));
            input.iter().map(|&input| input as usize).zip(outputs)
        })
    }

    /// Number of pairs, of all offsets.
    pub fn pairs(&self) -> usize {
        self.blocks.iter().map(|block| block.input.len()).sum()
    }

    /// The map that leads gradients back, and which offset of the weights its `offset` stands for:
    /// `volume - 1 - offset` if the flag is set, else `offset`.
    pub fn adjoint(&self) -> (&Self, bool) {
        if self.mirrored {
            return (self, true);
        }
        (self.adjoint.get_or_init(|| Box::new(self.transposed())), false)
    }

    /// The map of a kernel whose offsets are these of this one's, in order.
    pub(super) fn restricted(&self, offsets: &[usize]) -> Self {
        let blocks = self
            .blocks
            .par_iter()
            .map(|block| MapBlock::from_lists(offsets.iter().map(|&offset| block.pairs(offset))))
            .collect();
        Self::new(offsets.len(), self.inputs, self.outputs, self.mirrored, blocks)
    }

    /// Inputs and outputs swapped.
    pub fn transposed(&self) -> Self {
        let count = self.inputs.div_ceil(BLOCK_ROWS);
        let mut lists: Vec<Vec<(Vec<u32>, Vec<u16>)>> =
            vec![vec![(Vec::new(), Vec::new()); self.volume]; count];
        for (index, block) in self.blocks.iter().enumerate() {
            let first = (index * BLOCK_ROWS) as u32;
            for offset in 0..self.volume {
                let (input, output) = block.pairs(offset);
                for (&input, &output) in input.iter().zip(output) {
                    let list = &mut lists[input as usize / BLOCK_ROWS];
                    let (rows, locals) = &mut list[offset];
                    rows.push(first + u32::from(output));
                    locals.push((input as usize % BLOCK_ROWS) as u16);
                }
            }
        }
        let blocks = lists
            .par_iter()
            .map(|lists| {
                MapBlock::from_lists(lists.iter().map(|(a, b)| (a.as_slice(), b.as_slice())))
            })
            .collect();
        Self::new(self.volume, self.outputs, self.inputs, false, blocks)
    }
}
