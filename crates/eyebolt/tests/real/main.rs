//! What eyebolt promises on a real recording: a KUKA LBR Med7 before a ZED 2i, five configurations.
//!
//! Needs the shared data; without it every test here says that it is skipped.

mod bags;
mod measures;
mod promises;
mod recording;
mod refusals;
mod turned;
