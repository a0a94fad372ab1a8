//! PointNet++ (Qi et al., *PointNet++: deep hierarchical feature learning on point sets in a
//! metric space*, NeurIPS 2017), with one or several radii a level.

mod checks;
mod description;
mod network;
mod published;

pub use description::{Abstraction, PointNet2, Scale, Task};
