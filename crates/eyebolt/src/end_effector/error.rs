//! Why an end-effector has no shape to go by.

use crate::record::RecordError;
use eyebolt_robot::Input;

/// Why an end-effector has no shape to go by.
#[derive(Debug, thiserror::Error)]
pub enum EndEffectorError {
    /// A mesh cannot be read.
    #[error(transparent)]
    Shape(#[from] RecordError),
    /// Neither the link nor what hangs on it has a shape.
    #[error(
        "robot {robot}: end-effector {link} has no visual or collision shape, nor has any link below \
         it, so that nothing of it can be seen; name a link that has one with {}, or add its mesh to \
         the URDF",
        Input::END_EFFECTOR
    )]
    NoShape {
        /// The robot's name.
        robot: String,
        /// The end-effector link.
        link: String,
    },
    /// A shape without four points apart from each other.
    #[error(
        "robot {robot}: the shape of end-effector {link} is a point, a line or a triangle, which tells \
         no pose; name a link with a solid shape with {}",
        Input::END_EFFECTOR
    )]
    NoSolid {
        /// The robot's name.
        robot: String,
        /// The end-effector link.
        link: String,
    },
}

impl EndEffectorError {
    /// The input that is at fault or would help, where it is one.
    pub fn input(&self) -> Option<Input> {
        match self {
            Self::Shape(error) => error.input(),
            Self::NoShape { .. } | Self::NoSolid { .. } => Some(Input::END_EFFECTOR),
        }
    }
}
