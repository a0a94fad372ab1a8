//! A recording that is still being made.

use super::growing_scan::GrowingScan;
use super::options::BagOptions;
use super::recording::BagRecording;
use crate::bag::{Bag, MCAP_MAGIC as MAGIC};
use crate::error::RecordingError;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
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

    /// Whether the file at `path` may be one: an MCAP, or the empty file that is going to be one.
    ///
    /// # Errors
    ///
    /// A file that cannot be read.
    pub fn is_one(path: &Path) -> Result<bool, RecordingError> {
        let begins = ends_of(path)?.0;
        Ok(begins.iter().zip(MAGIC).all(|(byte, magic)| *byte == magic))
    }

    /// Whether its writer has written its end.
    ///
    /// # Errors
    ///
    /// A file that cannot be read.
    pub fn has_ended(&self) -> Result<bool, RecordingError> {
        Ok(ends_of(&self.path)?.1 == MAGIC)
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

/// The first bytes of a file, and the last ones that are not among them.
fn ends_of(path: &Path) -> Result<(Vec<u8>, Vec<u8>), RecordingError> {
    let read = || -> io::Result<(Vec<u8>, Vec<u8>)> {
        let mut file = File::open(path)?;
        let (mut first, mut last) = (Vec::new(), Vec::new());
        file.by_ref().take(MAGIC.len() as u64).read_to_end(&mut first)?;
        let length = file.seek(SeekFrom::End(0))?;
        let begin = length.saturating_sub(MAGIC.len() as u64).max(first.len() as u64);
        file.seek(SeekFrom::Start(begin))?;
        file.take(MAGIC.len() as u64).read_to_end(&mut last)?;
        Ok((first, last))
    };
    read().map_err(|cause| RecordingError::Read {
        path: path.to_path_buf(),
        field: "the recording".to_owned(),
        remedy: "Check its name; it has to be there before it is followed".to_owned(),
        cause,
    })
}
