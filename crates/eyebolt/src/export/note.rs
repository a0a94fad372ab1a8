//! What a person should know before using an export.

use super::frame_name::FrameName;
use eyebolt_robot::Input;
use std::fmt;

/// What a person should know before using an export.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Note {
    /// The calibration was refused.
    Refused {
        /// Its reasons, in one line.
        reasons: String,
    },
    /// The optical frame has a parent, so the root of its tree is placed instead.
    ChildIsRoot {
        /// The depth optical frame.
        optical: FrameName,
        /// Its parent.
        parent: FrameName,
        /// The root above both.
        root: FrameName,
    },
    /// The child asked for has a parent already.
    SecondParent {
        /// The child.
        child: FrameName,
        /// Its parent.
        parent: FrameName,
    },
    /// The recording's own frames place the camera already.
    Replaces {
        /// The frame that the camera's root hangs on.
        parent: FrameName,
        /// The root of the camera's frames.
        child: FrameName,
    },
    /// What the recording told of its frames makes no tree.
    NoTree {
        /// Why not.
        problem: String,
    },
    /// Nobody knows whether the optical frame has a parent.
    TreeUnknown {
        /// The depth optical frame.
        optical: FrameName,
    },
    /// The static transforms have no frame of the calibration.
    TreeApart {
        /// Where they come from.
        tree: String,
        /// The calibration's base.
        base: FrameName,
        /// The depth optical frame.
        optical: FrameName,
        /// The frames of the tree, for a person to read.
        known: String,
    },
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refused { reasons } => {
                write!(
                    f,
                    "the calibration was refused, and its pose is not to be trusted: {reasons}"
                )
            }
            Self::ChildIsRoot { optical, parent, root } => write!(
                f,
                "{optical} has the parent {parent} already, and a frame may have but one: exported \
                 is the pose of {root}, the root of the camera's frames"
            ),
            Self::SecondParent { child, parent } => write!(
                f,
                "{child} has the parent {parent} already: published beside it, this export would \
                 give {child} two parents, and tf would jump between them"
            ),
            Self::Replaces { parent, child } => write!(
                f,
                "the recording has a transform from {parent} to {child}, of an earlier calibration \
                 or of a description: this one is to stand in its place, so end whatever publishes \
                 that one"
            ),
            Self::NoTree { problem } => {
                write!(f, "the recorded frames are of no use here: {problem}")
            }
            Self::TreeUnknown { optical } => write!(
                f,
                "the recording has no /tf_static, so nobody knows here whether {optical} has a parent. \
                 If the camera's driver gives it one, this export gives it a second, and tf jumps \
                 between them: give {} then",
                Input::CAMERA_TREE
            ),
            Self::TreeApart { tree, base, optical, known } => write!(
                f,
                "{tree} has neither {base} nor {optical}, so it changes nothing; it has {known}. \
                 If the depth optical frame is one of these, name it with {}",
                Input::OPTICAL_FRAME
            ),
        }
    }
}
