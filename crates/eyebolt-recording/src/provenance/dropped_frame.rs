//! Frames that do not take part.

use std::fmt;

/// A frame of a bag that does not take part.
#[derive(Clone, Debug, PartialEq)]
pub struct DroppedFrame {
    /// Number of the frame among those of its topic, from 0.
    pub index: usize,
    /// Its stamp, seconds.
    pub stamp_s: f64,
    /// Why it does not take part.
    pub reason: DropReason,
}

/// Why a frame does not take part.
#[derive(Clone, Debug, PartialEq)]
pub enum DropReason {
    /// A joint moved while the frame was taken.
    Moving {
        /// The joint that moved most.
        joint: String,
        /// By how much, radians or metres.
        motion: f64,
        /// By how much it may.
        limit: f64,
    },
    /// No joint state is near.
    StaleJoints {
        /// A joint that is not told.
        joint: String,
        /// From the frame to the nearest joint state, seconds.
        age_s: f64,
    },
    /// It is stamped no later than a frame before it.
    StampBackward,
    /// The camera saw nothing: no pixel has depth.
    Empty,
    /// Its message is damaged.
    Unreadable(String),
}

impl fmt::Display for DropReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Moving { joint, motion, limit } => write!(
                f,
                "the arm moved: {joint} by {:.2} degrees, or {:.1} mm if it slides, meanwhile; {:.2} \
                 ({:.1}) are allowed",
                motion.to_degrees(),
                1e3 * motion,
                limit.to_degrees(),
                1e3 * limit
            ),
            Self::StaleJoints { joint, age_s } => {
                write!(f, "the nearest state of {joint} is {age_s:.2} s away")
            }
            Self::StampBackward => write!(f, "its time stamp is not later than the one before"),
            Self::Empty => write!(f, "no pixel has depth"),
            Self::Unreadable(problem) => write!(f, "{problem}"),
        }
    }
}

impl DropReason {
    /// The reason in a word, as it stands in JSON.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Moving { .. } => "moving",
            Self::StaleJoints { .. } => "no_joint_state_near",
            Self::StampBackward => "stamp_backward",
            Self::Empty => "empty",
            Self::Unreadable(_) => "unreadable",
        }
    }
}
