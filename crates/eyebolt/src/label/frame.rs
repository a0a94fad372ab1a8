//! Labels of single frames, for others to learn from: each pixel's class, keypoints, the
//! end-effector's pose.
//!
//! The calibration is known and good, so the drawn arm tells where the arm is to a pixel, and the
//! scene behind it is known from frames in which the arm stood elsewhere. What both say alike is
//! labelled. Depth near outlines is wrong in ways of its own with every kind of camera (fattened,
//! mixed, missing), so what they do not agree on is *ignore*.

mod backdrop;
mod classes;
mod consistency;
mod keypoints;
mod labeller;
mod near;
mod outline;
mod specks;

pub use consistency::Contradiction;
pub use labeller::{FrameLabeller, LabelledFrame};
