//! What is said of damaged records.

use crate::bag::bytes::Bytes;
use crate::bag::remedy::or_partial;
use crate::error::RecordingError;

/// The record at byte `at` says something that cannot be right.
pub(super) fn damaged(bytes: &Bytes, at: u64, problem: impl Into<String>) -> RecordingError {
    let remedy = or_partial(
        "The file is damaged: copy it again, repair it with `mcap recover`",
        "to use what can be read",
    );
    RecordingError::invalid(bytes.path(), format!("record at byte {at}"), problem, remedy)
}

/// The file ends within the record at byte `at`.
pub(super) fn cut_short(bytes: &Bytes, at: u64) -> RecordingError {
    let remedy = or_partial("Repair it with `mcap recover`", "to use what is before");
    RecordingError::CutShort { path: bytes.path().to_path_buf(), at, remedy }
}
