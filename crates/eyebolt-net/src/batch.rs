//! What a network is run on: features, and who is whose neighbour.

mod points;
mod prepared;
mod voxels;

pub use points::Sampling;
pub use prepared::{Batch, Map};
