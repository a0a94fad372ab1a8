//! Why a recording and a robot do not make observations.

use super::options::MOST_CONFIGURATIONS;
use eyebolt_recording::RecordingError;
use eyebolt_robot::{Input, KinematicsError, MeshError};

/// Why a recording and a robot do not make observations.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The recording cannot be read.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// A link's shape cannot be read.
    #[error("link {link}: {source}")]
    Mesh {
        /// The link.
        link: String,
        /// What is wrong with it.
        source: MeshError,
    },
    /// The recording's joints are not the robot's.
    #[error("frame {frame}: {source}")]
    Kinematics {
        /// Name of the frame.
        frame: String,
        /// What does not fit.
        source: KinematicsError,
    },
    /// The recording names joints of the arm, and never says where they are.
    #[error(
        "frame {frame}: {reasons}; record a publisher that tells where every joint of the arm is"
    )]
    JointsNotTold {
        /// Name of the first frame.
        frame: String,
        /// What is wrong with each joint.
        reasons: String,
    },
    /// A mask is not of the size of the images.
    #[error(
        "frame {frame}: frames.mask: {} x {} pixels, but the images are {} x {}; masks and clouds \
         of all frames must have one size", found.0, found.1, size.0, size.1
    )]
    MaskSize {
        /// Name of the frame.
        frame: String,
        /// Width and height of its mask.
        found: (u32, u32),
        /// Width and height of the images.
        size: (u32, u32),
    },
    /// A depth image is not of the camera's size.
    #[error(
        "{what}: the depth image is {} x {} pixels, but its camera has {} x {}", found.0, found.1, size.0, size.1
    )]
    ImageSize {
        /// Which frame or background.
        what: String,
        /// Width and height of the image.
        found: (u32, u32),
        /// Width and height that its camera has.
        size: (u32, u32),
    },
    /// A link is larger than any arm.
    #[error(
        "link {link}: {extent_m:.0} m long; a mesh in millimetres needs scale=\"0.001 0.001 0.001\", \
         and what the arm stands on belongs above its base ({})",
        Input::BASE
    )]
    HugeLink {
        /// The link.
        link: String,
        /// Its largest extent.
        extent_m: f32,
    },
    /// More links with shapes than an arm may have.
    #[error(
        "{count} links have a shape, more than 255; name the arm's own base with {}",
        Input::BASE
    )]
    TooManyLinks {
        /// How many there are.
        count: usize,
    },
    /// No link below the base has a shape.
    #[error(
        "robot {robot}: no link below {base} has a visual or collision shape, so there is nothing \
         to find in the images; give a URDF with meshes"
    )]
    NoShapes {
        /// The robot's name.
        robot: String,
        /// The base link.
        base: String,
    },
    /// There is nothing to calibrate with.
    #[error("there are no frames: add some, each with the joints that it was taken at")]
    NoFrames,
    /// Hardly two frames have the arm in one place.
    #[error(
        "the arm is in more than {MOST_CONFIGURATIONS} places: it never rests. Let it rest in each of some \
         configurations; with a bag, give a smaller {}",
        Input::MAX_MOTION
    )]
    NeverAtRest,
    /// Clouds without a camera that do not tell their own.
    #[error(
        "frame {frame}: {problem}; add [camera] info = \"...\" to recording.toml, or give {} \
         with a bag",
        Input::CAMERA_INFO
    )]
    Projection {
        /// Name of the frame.
        frame: String,
        /// What is wrong.
        problem: String,
    },
}

impl RecordError {
    /// The input that is at fault or would help, where it is one.
    pub fn input(&self) -> Option<Input> {
        match self {
            Self::Recording(error) => error.input(),
            Self::HugeLink { .. } | Self::TooManyLinks { .. } => Some(Input::BASE),
            Self::NeverAtRest => Some(Input::MAX_MOTION),
            Self::Projection { .. } => Some(Input::CAMERA_INFO),
            _ => None,
        }
    }
}
