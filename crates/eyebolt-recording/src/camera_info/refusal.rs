//! What is said of files that make no camera.

use crate::error::RecordingError;
use std::path::Path;

/// What the file is to the recording.
pub(super) const FIELD: &str = "camera info";

pub(super) const REMEDY: &str =
    "Store what `ros2 topic echo --once` prints of the camera_info topic";

pub(super) fn invalid(
    path: &Path,
    field: &str,
    problem: impl Into<String>,
    remedy: &str,
) -> RecordingError {
    RecordingError::invalid(path, field, problem, remedy)
}
