//! Parts of a description that cannot be used as they stand: no matter, unless the arm needs them.

use crate::error::RobotError;
use std::fmt;

/// A part that cannot be used.
#[derive(Clone, Debug)]
pub(crate) struct Flaw {
    pub(crate) of: Of,
    pub(crate) error: RobotError,
}

/// What a flaw is in; names, since links and joints are put in order later.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Of {
    /// A visual body of this link.
    Visual(String),
    /// A collision body of this link.
    Collision(String),
    /// A shape without any extent, a stand-in that nobody sees, in this link.
    Nothing(String),
    /// This joint: nobody knows what hangs on it.
    Joint(String),
    /// What this joint follows: its own record counts, if there is one.
    Mimic(String),
}

/// A part of the description that was left out, since the arm does not need it.
#[derive(Clone, Debug)]
pub struct LeftOut {
    /// What is wrong with it.
    pub problem: RobotError,
    /// What is done instead.
    pub instead: &'static str,
}

impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "left out, {}: {}", self.instead, self.problem)
    }
}
