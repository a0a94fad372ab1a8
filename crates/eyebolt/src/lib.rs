//! The stages of eyebolt.

pub mod calibrate;
pub mod label;
pub mod pose;
pub mod progress;
pub mod record;
pub mod refine;
pub mod report;
pub mod session;
