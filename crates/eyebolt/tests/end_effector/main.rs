//! Box, keypoints and symmetry of end-effectors, by laws that hold for any of them.

mod gripper;
mod keypoints;
mod panda;
mod shapes;
