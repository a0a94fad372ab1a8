//! Networks of the literature, as graphs, and files of them.
//!
//! Beside the networks of their inventors' publications stand those of the article that eyebolt
//! makes a program of: Sefercik and Akgun, *Learning Markerless Robot-Depth Camera Calibration and
//! End-Effector Pose Estimation*, CoRL 2022. "Sefercik and Akgun" below is that article, and their
//! published code where it says so: sizes of heads, for one, stand only there.

mod description;
mod minkunet;
mod model;
mod pointnet2;

pub use description::{Architecture, ModelDescription};
pub use minkunet::{Block, Head, MinkEncoder, MinkUNet};
pub use model::Model;
pub use pointnet2::{Abstraction, PointNet2, Scale, Task};
