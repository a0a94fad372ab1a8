//! Robot arms from URDF: links, meshes, forward kinematics.

mod joint_positions;

pub use joint_positions::JointPositions;
