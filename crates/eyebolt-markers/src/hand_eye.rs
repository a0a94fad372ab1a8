//! Where a camera is against a robot, from a marker seen in several positions of the robot.
//!
//! One equation serves both arrangements: `camera_from_marker = camera_from_root * root_from_carrier *
//! carrier_from_marker`, in which `root_from_carrier` is known from the joints. A camera that stands still and
//! sees a marker on the hand has the base as root and the end-effector as carrier (*eye-to-hand*); a camera on
//! the hand that sees a marker standing still has the end-effector as root and the base as carrier
//! (*eye-in-hand*).

mod daniilidis;
mod horaud_dornaika;
mod left_out;
mod motion;
mod park_martin;
mod poses;
mod refine;
mod refine_poses;
mod solver;
mod start;
mod system;
mod tsai_lenz;

pub use left_out::LeftOut;
pub use poses::{HandEye, PosePair, View};
pub use refine::{Refined, ViewFit, refine};
pub use refine_poses::refine_poses;
pub use solver::{HandEyeError, Solver, solve};
pub use start::{Start, starts};
