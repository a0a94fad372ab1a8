//! The pose of an end-effector from one frame.

mod judging;
mod scene;
mod shipped;
