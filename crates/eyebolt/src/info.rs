//! What is in a recording, what of it fits the robot, and what to do about the rest.

mod advice;
mod depth;
mod form;
mod look;

pub use advice::NO_ROBOT;
pub use form::{Clock, Configuration, Depth, Dropped, Frames, Info, RobotFit, SCHEMA, Untold};
