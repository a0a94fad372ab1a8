//! Where voxels are, and which are neighbours of which.
//!
//! Voxels are kept in Morton order, item after item of a batch: neighbours in space are mostly
//! neighbours in memory, a coarser resolution is found by shifting codes, and its voxels come in
//! the same order.

mod bricks;
mod generic;
mod kernel;
mod kernel_map;
mod morton;
mod neighbours;
mod strided;
mod voxel_set;
mod voxelise;
mod window;

pub use kernel::{Kernel, KernelSpec};
pub use kernel_map::{BLOCK_ROWS, KernelMap, MapBlock};
pub use neighbours::Neighbours;
pub use voxel_set::{COORDINATE_LIMIT, MAX_ITEMS, VoxelSet};
pub use voxelise::{average_features, vote_labels, voxelise};
