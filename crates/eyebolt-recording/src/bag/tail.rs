//! A file of messages that is still being written.

use super::bytes::Bytes;
use super::locator::Locator;
use super::mcap::{McapFile, Reached};
use super::message::Message;
use crate::error::RecordingError;
use std::path::{Path, PathBuf};

/// An MCAP that is still being written: what came since it was last looked at.
#[derive(Debug)]
pub(crate) struct McapTail {
    path: PathBuf,
    reached: Reached,
}

impl McapTail {
    /// Of the file at `path`, from its beginning.
    pub(crate) fn new(path: &Path) -> Self {
        Self { path: path.to_path_buf(), reached: Reached::default() }
    }

    /// Hands every message that is whole by now, and was not before, to `each`.
    ///
    /// # Errors
    ///
    /// A file that cannot be read, or a damaged record: nobody but its writer should have touched it.
    pub(crate) fn scan(
        &mut self,
        each: &mut dyn FnMut(Locator, &Message<'_>),
    ) -> Result<(), RecordingError> {
        let file = McapFile::new(Bytes::open(&self.path)?);
        file.scan_on(&mut self.reached, &mut |message| {
            each(Locator::new(0, message.place), message);
            Ok(())
        })
    }
}
