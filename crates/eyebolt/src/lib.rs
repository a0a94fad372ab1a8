//! The stages of eyebolt.

pub mod answer;
pub mod calibrate;
pub mod evaluate;
pub mod export;
pub mod info;
pub mod label;
pub mod pipeline;
pub mod pose;
pub mod progress;
pub mod record;
pub mod refine;
pub mod report;
pub mod robots;
pub mod session;
pub mod simulate;
