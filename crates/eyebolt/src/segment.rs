//! Which pixels are the arm, and which the end-effector, by what a network learned.

mod cluster;
mod end_effector_net;
mod features;
mod grid;
mod open;
mod segmenter;
mod thinned;
mod upsample;
mod window;

pub use end_effector_net::{CLASSES, EndEffectorNet, window_batch};
pub use features::{FEATURES, features};
pub use grid::Grid;
pub use segmenter::{
    ARM, BACKGROUND, END_EFFECTOR, SegmentError, Segmentation, Segmenter, UNKNOWN,
};
pub use thinned::Thinned;
pub use window::{
    WINDOW_COLUMNS, WINDOW_FEATURES, Window, part_around, window_half_m, window_step,
};
