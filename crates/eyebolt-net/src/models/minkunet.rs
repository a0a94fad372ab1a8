//! The MinkUNet family (Choy, Gwak and Savarese, *4D spatio-temporal ConvNets: Minkowski
//! convolutional neural networks*, CVPR 2019, with the names and layers of its published code).

mod blocks;
mod checks;
mod encoder;
mod published;
mod segmentation;

pub use blocks::Block;
pub use encoder::MinkEncoder;
pub use segmentation::{Head, MinkUNet};
