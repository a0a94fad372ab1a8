//! What can be wrong with a data set.

use eyebolt_recording::RecordingError;
use eyebolt_robot::Input;
use std::io;
use std::path::Path;

/// Why a data set cannot be read or written. The text names file, field and remedy.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DatasetError {
    /// An array is not one of NumPy's.
    #[error(transparent)]
    Array(#[from] RecordingError),
    /// The operating system would not give the file.
    #[error("{file}: cannot read: {cause}. {remedy}")]
    Read {
        /// The file.
        file: String,
        /// What the operating system said. Part of the text, so no `source` of the error.
        cause: io::Error,
        /// What to do about it.
        remedy: String,
    },
    /// The operating system would not take the file.
    #[error(
        "{file}: cannot write: {cause}. Make room there, or name another folder with {}; what is there is \
         whole, and is not labelled again",
        Input::OUTPUT
    )]
    Write {
        /// The file.
        file: String,
        /// What the operating system said, without the name of a temporary file that nobody knows.
        cause: io::ErrorKind,
    },
    /// The file is there and says something that cannot be right.
    #[error("{file}: {field}: {problem}. {remedy}")]
    Invalid {
        /// The file.
        file: String,
        /// The field, or the place in the file.
        field: String,
        /// What was found there.
        problem: String,
        /// What to do about it.
        remedy: String,
    },
}

impl DatasetError {
    pub(super) fn invalid(
        path: &Path,
        field: impl Into<String>,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self::Invalid {
            file: path.display().to_string(),
            field: field.into(),
            problem: problem.into(),
            remedy: remedy.into(),
        }
    }

    pub(super) fn write(path: &Path, cause: &io::Error) -> Self {
        Self::Write { file: path.display().to_string(), cause: cause.kind() }
    }

    /// The input that is at fault or would help, where it is one.
    pub fn input(&self) -> Option<Input> {
        match self {
            Self::Write { .. } => Some(Input::OUTPUT),
            Self::Array(error) => error.input(),
            Self::Read { .. } | Self::Invalid { .. } => None,
        }
    }
}
