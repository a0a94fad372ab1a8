//! What is said of a field of a calibration file.

use crate::export::error::ExportError;

/// What to do about a file that is not as it was written.
pub(super) const REMEDY: &str = "Export the file as `eyebolt calibrate` wrote it";

/// The error of a field that is not there.
pub(super) fn missing(file: &str, field: &str) -> ExportError {
    ExportError::invalid(file, field, "the field is missing", REMEDY)
}
