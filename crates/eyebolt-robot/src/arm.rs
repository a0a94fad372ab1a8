//! The part of a robot between a base link and an end-effector link.

mod chain;
mod flawless;
mod guess;
mod kinematics;
mod walk;

pub use chain::{Arm, Guessed, OutsideLimits};
pub use kinematics::{KnownPoses, LinkPoses, PosesWithDefaults};
