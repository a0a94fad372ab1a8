//! What eyebolt promises on real recordings: a KUKA LBR Med7 before a ZED 2i, five configurations, and
//! two others.
//!
//! Needs the shared data; without it every test here says that it is skipped.

mod bags;
mod labels;
mod measures;
mod others;
mod promises;
mod recording;
mod refusals;
mod turned;
