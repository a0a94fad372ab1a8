//! All resolutions and maps of one batch, each built when first asked for.

use super::kernel::MAX_STEP;
use super::{KernelMap, KernelSpec, VoxelSet, generic, strided, window};
use crate::Error;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The voxels of a batch at every resolution that its network asks for, and the maps between them.
#[derive(Debug)]
pub struct Neighbours {
    sets: BTreeMap<u32, Arc<VoxelSet>>,
    /// Parents of the voxels of one stride among those of another.
    parents: BTreeMap<(u32, u32), Vec<u32>>,
    maps: BTreeMap<KernelSpec, Arc<KernelMap>>,
}

impl Neighbours {
    /// Of the finest voxels.
    pub fn new(finest: VoxelSet) -> Self {
        let sets = BTreeMap::from([(finest.stride(), Arc::new(finest))]);
        Self { sets, parents: BTreeMap::new(), maps: BTreeMap::new() }
    }

    /// The voxels of a stride, made from the coarsest set that is finer and divides it.
    ///
    /// # Errors
    /// If the stride is not a multiple of one that is there, or a step beyond 64.
    pub fn voxels(&mut self, stride: u32) -> Result<Arc<VoxelSet>, Error> {
        if let Some(set) = self.sets.get(&stride) {
            return Ok(set.clone());
        }
        let place = || format!("voxels of stride {stride}");
        let finer = self.sets.iter().rev().find(|(have, _)| stride.is_multiple_of(**have));
        let Some((&have, set)) = finer.filter(|(have, _)| stride > **have) else {
            return Err(Error::network(place(), "no finer ones to make them from"));
        };
        let factor = stride / have;
        if factor > MAX_STEP {
            return Err(Error::network(place(), format!("{factor} times as large as the next")));
        }
        let (coarse, parents) = set.coarser(factor);
        let coarse = Arc::new(coarse);
        self.parents.insert((have, stride), parents);
        self.sets.insert(stride, coarse.clone());
        Ok(coarse)
    }

    /// The map of a convolution.
    ///
    /// # Errors
    /// If the kernel is empty or too wide, or the resolutions are not multiples of each other.
    pub fn map(&mut self, spec: KernelSpec) -> Result<Arc<KernelMap>, Error> {
        if let Some(map) = self.maps.get(&spec) {
            return Ok(map.clone());
        }
        spec.check()?;
        let map = Arc::new(if spec.from > spec.to {
            let forward = KernelSpec { from: spec.to, to: spec.from, ..spec };
            self.map(forward)?.transposed()
        } else {
            self.build(spec)?
        });
        self.maps.insert(spec, map.clone());
        Ok(map)
    }

    /// From a map that is there already, of a wider kernel: copying pairs is faster than searching.
    fn part_of_wider(&self, spec: KernelSpec) -> Option<KernelMap> {
        let same = |other: &KernelSpec| (other.from, other.to) == (spec.from, spec.to);
        self.maps.iter().filter(|(other, _)| same(other)).find_map(|(other, map)| {
            let wider = other.kernel.offsets();
            let place = |offset| wider.iter().position(|have| have == offset);
            let offsets: Option<Vec<usize>> = spec.kernel.offsets().iter().map(place).collect();
            // Both around the voxel, or both from it: else the reverse pass would go astray.
            let alike = other.kernel.size % 2 == spec.kernel.size % 2;
            Some(map.restricted(&offsets.filter(|_| alike)?))
        })
    }

    fn build(&mut self, spec: KernelSpec) -> Result<KernelMap, Error> {
        let (fine, coarse) = (self.voxels(spec.from)?, self.voxels(spec.to)?);
        let factor = spec.to / spec.from;
        if let Some(map) = self.part_of_wider(spec) {
            return Ok(map);
        }
        if factor == 1 && window::fits(spec.kernel) {
            return Ok(window::build(&fine, spec.kernel));
        }
        let parents = self.parents.get(&(spec.from, spec.to));
        if let Some(parents) = parents.filter(|_| strided::fits(spec.kernel, factor)) {
            return Ok(strided::build(&fine, &coarse, parents, spec.kernel));
        }
        Ok(generic::build(&fine, &coarse, spec.kernel, factor))
    }
}
