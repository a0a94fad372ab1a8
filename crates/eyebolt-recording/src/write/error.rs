//! Why nothing was written.

use crate::error::RecordingError;
use std::io;
use std::path::PathBuf;

/// Why a recording could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The recording cannot be read.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// A file cannot be written.
    #[error("{path}: cannot write: {cause}. Make room there, or name another place", path = path.display())]
    File {
        /// The file or folder.
        path: PathBuf,
        /// What the operating system said. Part of the text, so no `source` of the error.
        cause: io::Error,
    },
    /// What was to be written fits no recording.
    #[error("{what} at {:.3} s: {problem}", *stamp_ns as f64 * 1e-9)]
    Unfit {
        /// What it was to be.
        what: &'static str,
        /// Its stamp.
        stamp_ns: i64,
        /// Why it does not fit.
        problem: String,
    },
    /// There is no frame to write.
    #[error(
        "{path}: frames: all {count} were left out: {reasons}. Record it again", path = path.display(),
        reasons = reasons.join("; ")
    )]
    NoFrameLeft {
        /// The recording.
        path: PathBuf,
        /// How many frames it has.
        count: usize,
        /// Why frames were left out, with how many for each reason, the most frequent first.
        reasons: Vec<String>,
    },
    /// Whoever was told of the progress wanted it to end.
    #[error("stopped; nothing was written")]
    Stopped,
}
