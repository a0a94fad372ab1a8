//! Laws and oracles of sparse networks.

mod coordinates;
mod executors;
mod gradients;
mod scenes;
