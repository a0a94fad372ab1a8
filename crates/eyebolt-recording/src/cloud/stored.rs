//! A cloud as its file has it, within limits, and what is said of files that have none.

use crate::error::RecordingError;
use std::path::Path;

/// What the files are to the recording.
pub(super) const FIELD: &str = "cloud";

/// Most points of a PCD or PLY file: twice what a camera with 4K gives.
pub(super) const MOST_POINTS: usize = 1 << 24;

/// Largest PCD or PLY file, and most that a compressed one holds, bytes. Both are in memory at
/// once; it is 16 bytes for each of the most points, or 48 for each of 5 million.
pub(super) const LARGEST: u64 = 256 << 20;

/// Most bytes before the data of a PCD or PLY file.
pub(super) const LARGEST_HEADER: usize = 64 << 10;

/// A cloud in the unit and the frame of its file.
#[derive(Debug)]
pub(crate) struct Stored {
    /// Three coordinates for every point.
    pub(crate) xyz: Vec<f32>,
    /// Width and height, if the points are in the order of an image.
    pub(crate) grid: Option<(u32, u32)>,
}

/// Something is wrong with the file at `path`.
pub(super) fn invalid(path: &Path, problem: impl Into<String>, remedy: &str) -> RecordingError {
    RecordingError::invalid(path, FIELD, problem, remedy)
}

/// The file has not the bytes that its header tells.
pub(super) fn damaged(path: &Path, problem: impl Into<String>) -> RecordingError {
    invalid(path, problem, "The file is damaged or cut short: copy or write it again")
}

/// Refuses more points than are read here.
pub(super) fn check_count(path: &Path, count: usize) -> Result<(), RecordingError> {
    if count <= MOST_POINTS {
        return Ok(());
    }
    let problem = format!("the header tells of {count} points, more than {MOST_POINTS}");
    Err(invalid(path, problem, "Name the right file, or thin the cloud out"))
}
