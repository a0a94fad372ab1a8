//! Which pixels are the arm, and which the end-effector, by what a network learned.

mod classes;
mod cluster;
mod confusion;
mod end_effector_net;
mod error;
mod features;
mod grid;
mod middle;
mod open;
mod second_opinion;
mod segmenter;
mod thinned;
mod told;
mod upsample;
mod window;

pub use classes::{ARM, BACKGROUND, CLASSES, END_EFFECTOR, UNKNOWN};
pub use confusion::{ClassScore, Confusion};
pub use end_effector_net::{EndEffectorNet, window_batch};
pub use error::SegmentError;
pub use features::{FEATURES, features};
pub use grid::Grid;
pub use middle::middle;
pub use segmenter::{Segmentation, Segmenter};
pub use thinned::Thinned;
pub use told::Told;
pub use window::{
    WINDOW_COLUMNS, WINDOW_FEATURES, Window, part_around, window_half_m, window_step,
};
