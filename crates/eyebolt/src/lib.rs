//! The stages of eyebolt.

pub mod answer;
pub mod batch;
pub mod calibrate;
mod connected;
pub mod dataset;
pub mod depth_noise;
pub mod end_effector;
pub mod evaluate;
mod evenly;
pub mod export;
pub mod info;
pub mod joint_limits;
pub mod label;
#[cfg(test)]
mod made_up;
pub mod marker_answer;
pub mod markers;
pub mod model_files;
pub mod monitor;
pub mod networks;
pub mod observations;
mod other_unit;
pub mod paper;
pub mod pipeline;
pub mod plan;
pub mod pose;
pub mod progress;
pub mod record;
pub mod refine;
pub mod report;
pub mod robots;
pub mod segment;
pub mod simulate;
pub mod study;
pub mod train;
