//! Frames that are not written, and why.

use crate::error::RecordingError;
use crate::write::error::WriteError;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// How many frames were left out for which reason.
#[derive(Debug, Default)]
pub(super) struct LeftOut {
    reasons: BTreeMap<String, usize>,
    path: PathBuf,
}

impl LeftOut {
    /// Counts a frame that cannot be read.
    pub(super) fn add(&mut self, error: &RecordingError) {
        *self.reasons.entry(error.problem()).or_default() += 1;
        self.path = error.path().to_path_buf();
    }

    /// That no frame is left, with the reasons, the most frequent first.
    pub(super) fn none_left(self) -> WriteError {
        let count = self.reasons.values().sum();
        let mut reasons: Vec<_> = self.reasons.into_iter().collect();
        reasons.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        let reasons = reasons.into_iter().map(|(reason, count)| format!("{reason} ({count})"));
        WriteError::NoFrameLeft { path: self.path, count, reasons: reasons.collect() }
    }
}
