//! A pattern that fits no file.

use crate::error::RecordingError;
use crate::pattern::Pattern;
use std::path::Path;

/// Says that no file is called as `field` of the description at `path` wants it.
pub(super) fn none_fits(path: &Path, field: &str, files: &Pattern) -> RecordingError {
    let problem =
        format!("no file in {} is called \"{}\"", files.folder().display(), files.file_name());
    RecordingError::invalid(path, field, problem, "Correct the pattern, or copy the files there")
}
