//! What stops a scan, and who decides whether it goes on.

use crate::bag::message::Message;
use crate::bag::remedy::or_partial;
use crate::error::RecordingError;
use std::path::Path;

const DAMAGED: (&str, &str) = ("The file is damaged: copy it again", "to use the rest");
const CUT: (&str, &str) =
    ("Was the recorder killed? Repair it with `rosbag reindex`", "to use what is before");

/// Why a record cannot be used.
#[derive(Debug)]
pub(super) enum Fault {
    /// The file cannot be read, or whoever takes the messages wants no more.
    Fatal(RecordingError),
    /// The record says something that cannot be right.
    Damage {
        /// What was found.
        problem: String,
        /// What to do about it.
        remedy: String,
    },
}

impl Fault {
    /// The file ends before `problem` is over.
    pub(super) fn cut(problem: impl Into<String>) -> Self {
        Self::Damage { problem: problem.into(), remedy: or_partial(CUT.0, CUT.1) }
    }

    /// As an error about the part `field` of the file at `path`.
    pub(super) fn at(self, path: &Path, field: impl Into<String>) -> RecordingError {
        match self {
            Self::Fatal(error) => error,
            Self::Damage { problem, remedy } => {
                RecordingError::invalid(path, field, problem, remedy)
            }
        }
    }
}

impl From<RecordingError> for Fault {
    fn from(error: RecordingError) -> Self {
        Self::Fatal(error)
    }
}

impl From<String> for Fault {
    fn from(problem: String) -> Self {
        Self::Damage { problem, remedy: or_partial(DAMAGED.0, DAMAGED.1) }
    }
}

impl From<&str> for Fault {
    fn from(problem: &str) -> Self {
        Self::from(problem.to_owned())
    }
}

/// Who takes what a scan finds.
pub(super) struct Taker<'t> {
    /// Takes the messages.
    pub(super) each: &'t mut dyn FnMut(&Message<'_>) -> Result<(), RecordingError>,
    /// Decides about damage.
    pub(super) damage: &'t mut dyn FnMut(RecordingError) -> Result<(), RecordingError>,
}

impl Taker<'_> {
    /// Asks about a fault in the part `field`: `Ok` goes on behind it.
    pub(super) fn decide(
        &mut self,
        fault: Fault,
        path: &Path,
        field: String,
    ) -> Result<(), RecordingError> {
        match fault {
            Fault::Fatal(error) => Err(error),
            damage @ Fault::Damage { .. } => (self.damage)(damage.at(path, field)),
        }
    }
}
