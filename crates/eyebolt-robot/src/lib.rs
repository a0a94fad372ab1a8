//! Robot arms from URDF and xacro: links, joints, forward kinematics, meshes.
//!
//! [`Robot`] is the kinematic tree of a URDF. [`Robot::arm`] picks the base and the end-effector
//! link, and the [`Arm`] gives the pose of every link for [`JointPositions`]. Meshes are read only
//! when [`load_body`] or [`link_mesh`] asks for them.
//!
//! SI units and radians. The format follows <http://wiki.ros.org/urdf/XML>.

mod arm;
mod descriptions;
mod error;
mod fingerprint;
mod flaw;
mod input;
mod joint_positions;
mod mesh;
mod packages;
mod robot;
mod tree;
mod urdf;
mod xacro;
mod xml;

pub use arm::{Arm, Guessed, KnownPoses, LinkPoses, OutsideLimits, PosesWithDefaults};
pub use error::{KinematicsError, RobotError, joint_prefix};
pub use fingerprint::{Fingerprint, body_fingerprint, link_fingerprint};
pub use flaw::LeftOut;
pub use input::Input;
pub use joint_positions::JointPositions;
pub use mesh::{
    MAX_MESH_BYTES, MAX_TRIANGLES, MeshError, Prefer, TriangleMesh, link_mesh, load_body,
};
pub use packages::{PackageRoots, Remedy, ResolveError};
pub use robot::{Body, Joint, JointKind, JointLimits, Link, Mimic, Robot, Shape};
pub use urdf::{Description, MAX_URDF_BYTES};
pub use xacro::XacroArguments;
