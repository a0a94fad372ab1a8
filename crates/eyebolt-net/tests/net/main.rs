//! Laws and oracles of sparse networks.

mod bad_input;
mod coordinates;
mod executors;
mod fixtures;
mod gradients;
mod learning;
mod minkowski;
mod model_files;
mod outside;
mod published;
mod pytorch_minkunet;
mod pytorch_operations;
mod pytorch_points;
mod pytorch_training;
mod runs;
mod scenes;
mod weight_layouts;
mod weights;
