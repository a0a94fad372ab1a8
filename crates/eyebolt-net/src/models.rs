//! Networks of the literature, as graphs.

mod minkunet;

pub use minkunet::{Block, Head, MinkUNet};
