//! Laws of the crate, then pictures and poses of others.

mod draw;
mod gold;
mod hand_eye;
mod moveit;
mod noise;
mod rendered;
mod shared;
mod single;
mod strategies;
