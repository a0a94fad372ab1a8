//! Networks of the literature, as graphs, and files of them.

mod description;
mod minkunet;
mod model;
mod pointnet2;

pub use description::{Architecture, ModelDescription};
pub use minkunet::{Block, Head, MinkUNet};
pub use model::Model;
pub use pointnet2::{Abstraction, PointNet2, Scale, Task};
