//! The stages of eyebolt.

pub mod calibrate;
pub mod label;
pub mod pose;
pub mod record;
pub mod refine;
pub mod session;
