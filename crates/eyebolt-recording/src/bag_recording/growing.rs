//! A recording that is still being made.

use super::growing_scan::GrowingScan;
use super::options::BagOptions;
use super::recording::BagRecording;
use crate::bag::Bag;
use crate::error::RecordingError;
use std::path::{Path, PathBuf};

/// A recording in MCAP that is still being made: asked again, it reads what came since.
#[derive(Debug)]
pub struct GrowingRecording {
    path: PathBuf,
    options: BagOptions,
    scan: GrowingScan,
}

impl GrowingRecording {
    /// Of the MCAP at `path`, to be read as `options` say.
    pub fn new(path: &Path, options: BagOptions) -> Self {
        Self { path: path.to_path_buf(), options, scan: GrowingScan::new(path) }
    }

    /// The recording as it is now: the same as [`BagRecording::open`] makes of the file.
    ///
    /// # Errors
    ///
    /// As of [`BagRecording::open`]: in the beginning, that something is not there yet.
    pub fn now(&mut self) -> Result<BagRecording, RecordingError> {
        let scan = self.scan.now()?;
        let bag = Bag::open(&self.path, self.options.scratch())?;
        BagRecording::of_scan(&self.path, bag, scan, &self.options)
    }
}
