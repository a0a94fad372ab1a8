//! Which pixels are the arm, and which the end-effector, by what a network learned.

mod cluster;
mod features;
mod grid;
mod segmenter;
mod thinned;
mod upsample;

pub use features::{FEATURES, features};
pub use grid::Grid;
pub use segmenter::{
    ARM, BACKGROUND, END_EFFECTOR, SegmentError, Segmentation, Segmenter, UNKNOWN,
};
pub use thinned::{Thinned, rays, size, step};
