//! Networks of the literature, as graphs, and files of them.

mod description;
mod minkunet;
mod pointnet2;

pub use description::{Architecture, Model, ModelDescription};
pub use minkunet::{Block, Head, MinkUNet};
pub use pointnet2::{Abstraction, PointNet2, Scale, Task};
