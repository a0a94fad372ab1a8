//! The part of a robot between a base link and an end-effector link.

mod chain;
mod guess;
mod kinematics;
mod walk;

pub use chain::{Arm, OutsideLimits};
pub use kinematics::{LinkPoses, PosesWithDefaults};
