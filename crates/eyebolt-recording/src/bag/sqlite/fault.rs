//! What is said of damaged databases.

use crate::bag::remedy::or_partial;
use crate::error::RecordingError;
use std::path::Path;

/// The database at `path` cannot be read on.
pub(super) fn damaged(path: &Path, error: &rusqlite::Error) -> RecordingError {
    let remedy = "The file is damaged or no bag: copy it again, or recover it with the `.recover` \
                  command of sqlite3";
    RecordingError::invalid(path, "database", error.to_string(), remedy)
}

/// The message of this number says something that cannot be right.
pub(super) fn bad_row(path: &Path, row: i64, problem: impl Into<String>) -> RecordingError {
    let remedy = or_partial("The message is damaged: copy the bag again", "to go without it");
    RecordingError::invalid(path, format!("message {row}"), problem, remedy)
}
