//! What can be wrong with a recording.

use eyebolt_robot::Input;
use std::io;
use std::path::{Path, PathBuf};

/// What is wrong with a frame that saw nothing.
const NO_DEPTH: &str = "no pixel has depth";

/// What is wrong with a file that ends before it should.
const ENDS_EARLY: &str = "the file ends in the middle of it, as when a recorder is killed";

/// Why a recording, or a frame of it, cannot be read. The text names file, field and remedy.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordingError {
    /// The operating system would not give the file.
    #[error("{path}: cannot read {field}: {cause}. {remedy}", path = path.display())]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// What the file is to the recording.
        field: String,
        /// What to do about it.
        remedy: String,
        /// What the operating system said. Part of the text, so no `source` of the error.
        cause: io::Error,
    },
    /// The file is there and says something that cannot be right.
    #[error("{path}: {field}: {problem}. {remedy}", path = path.display())]
    Invalid {
        /// The file.
        path: PathBuf,
        /// The field, or the part of the file.
        field: String,
        /// What was found there.
        problem: String,
        /// What to do about it.
        remedy: String,
        /// The input that says so, if it is not the file's own content. Then `field` is its name.
        input: Option<Input>,
    },
    /// The file ends within a record.
    #[error("{path}: record at byte {at}: {ENDS_EARLY}. {remedy}", path = path.display())]
    CutShort {
        /// The file.
        path: PathBuf,
        /// Where the record starts that is not whole.
        at: u64,
        /// What to do about it.
        remedy: String,
    },
    /// A frame saw nothing.
    #[error("{path}: {field}: {NO_DEPTH}. Record it again, or leave it out", path = path.display())]
    EmptyFrame {
        /// The recording.
        path: PathBuf,
        /// Topic and time of the frame.
        field: String,
    },
    /// There is no background of that index.
    #[error("{path}: background index {index} does not exist. The recording has {count} backgrounds, counted from 0", path = path.display())]
    NoSuchBackground {
        /// The recording.
        path: PathBuf,
        /// The index asked for.
        index: usize,
        /// How many backgrounds there are.
        count: usize,
    },
    /// There is no frame of that index.
    #[error("{path}: frame index {index} does not exist. The recording has {count} frames, counted from 0", path = path.display())]
    NoSuchFrame {
        /// The recording.
        path: PathBuf,
        /// The index asked for.
        index: usize,
        /// How many frames there are.
        count: usize,
    },
}

impl RecordingError {
    pub(crate) fn invalid(
        path: &Path,
        field: impl Into<String>,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self::Invalid {
            path: path.to_path_buf(),
            field: field.into(),
            problem: problem.into(),
            remedy: remedy.into(),
            input: None,
        }
    }

    /// What was handed in as `input` does not fit the recording at `path`.
    pub(crate) fn of_input(
        path: &Path,
        input: Input,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self::Invalid {
            path: path.to_path_buf(),
            field: input.to_string(),
            problem: problem.into(),
            remedy: remedy.into(),
            input: Some(input),
        }
    }

    /// The bag at `path` cannot be read.
    pub(crate) fn unreadable_bag(path: &Path, cause: io::Error) -> Self {
        Self::Read {
            path: path.to_path_buf(),
            field: "the bag".to_owned(),
            remedy: "Check that the file exists and may be read".to_owned(),
            cause,
        }
    }

    /// What is wrong, without the file, the field and the remedy.
    pub(crate) fn problem(&self) -> String {
        match self {
            Self::Invalid { problem, .. } => problem.clone(),
            Self::Read { cause, .. } => cause.to_string(),
            Self::CutShort { .. } => ENDS_EARLY.to_owned(),
            Self::EmptyFrame { .. } => NO_DEPTH.to_owned(),
            Self::NoSuchFrame { .. } | Self::NoSuchBackground { .. } => self.to_string(),
        }
    }

    /// The same, told of the file at `path`: what was read may be a copy of it.
    pub(crate) fn told_of(mut self, told: &Path) -> Self {
        match &mut self {
            Self::Read { path, .. }
            | Self::Invalid { path, .. }
            | Self::CutShort { path, .. }
            | Self::EmptyFrame { path, .. }
            | Self::NoSuchBackground { path, .. }
            | Self::NoSuchFrame { path, .. } => *path = told.to_path_buf(),
        }
        self
    }

    /// The file or folder that the error is about.
    pub fn path(&self) -> &Path {
        match self {
            Self::Read { path, .. }
            | Self::Invalid { path, .. }
            | Self::CutShort { path, .. }
            | Self::EmptyFrame { path, .. }
            | Self::NoSuchBackground { path, .. }
            | Self::NoSuchFrame { path, .. } => path,
        }
    }

    /// The input at fault, where it is one and not what the file says.
    pub fn input(&self) -> Option<Input> {
        match self {
            Self::Invalid { input, .. } => *input,
            Self::Read { .. }
            | Self::CutShort { .. }
            | Self::EmptyFrame { .. }
            | Self::NoSuchBackground { .. }
            | Self::NoSuchFrame { .. } => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_input_at_fault_is_told_by_name_and_as_itself() {
        let path = Path::new("a.mcap");
        let error = RecordingError::of_input(path, Input::DEPTH_TOPIC, "no such topic", "Give one");
        assert_eq!(error.to_string(), "a.mcap: argument `depth_topic`: no such topic. Give one");
        assert_eq!(error.input(), Some(Input::DEPTH_TOPIC));
        let error = RecordingError::invalid(path, "magic", "the file is not MCAP", "Give another");
        assert_eq!(error.input(), None);
    }
}
