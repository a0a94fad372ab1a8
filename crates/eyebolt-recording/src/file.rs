//! Files into memory, up to a limit.

use crate::error::RecordingError;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Largest file of depth, points, masks, colour or joints, bytes.
pub(crate) const DATA_LIMIT: u64 = 512 << 20;

/// Largest `recording.toml`, `camera_info.yaml` or joints of one frame as text, bytes.
pub(crate) const TEXT_LIMIT: u64 = 1 << 20;

/// All bytes of the file at `path`, which is `field` to the recording.
pub(crate) fn read_bytes(path: &Path, field: &str, limit: u64) -> Result<Vec<u8>, RecordingError> {
    let failed = |cause: io::Error| RecordingError::Read {
        path: path.to_path_buf(),
        field: field.to_owned(),
        remedy: "Check that the file exists and may be read".to_owned(),
        cause,
    };
    let file = File::open(path).map_err(failed)?;
    let length = file.metadata().map_err(failed)?.len();
    if length > limit {
        return Err(too_large(path, field, limit));
    }
    // The length is a hint: a file may grow, and a pipe has none.
    let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or(0));
    file.take(limit + 1).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > limit {
        return Err(too_large(path, field, limit));
    }
    Ok(bytes)
}

/// The text of the file at `path`, which is `field` to the recording.
pub(crate) fn read_text(path: &Path, field: &str) -> Result<String, RecordingError> {
    read_long_text(path, field, TEXT_LIMIT)
}

/// As [`read_text`], up to another limit.
pub(crate) fn read_long_text(
    path: &Path,
    field: &str,
    limit: u64,
) -> Result<String, RecordingError> {
    String::from_utf8(read_bytes(path, field, limit)?).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        RecordingError::invalid(
            path,
            field,
            format!("byte {at} is not UTF-8"),
            "Store the file as UTF-8 text",
        )
    })
}

fn too_large(path: &Path, field: &str, limit: u64) -> RecordingError {
    let found = format!("the file is larger than {} MiB", limit >> 20);
    RecordingError::invalid(path, field, found, "Name the right file, or split it into frames")
}
