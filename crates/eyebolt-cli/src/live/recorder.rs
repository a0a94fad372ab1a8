//! What comes in, on disk.

use crate::output;
use anyhow::{Result, anyhow};
use eyebolt_live::Incoming;
use eyebolt_recording::{SessionWriter, WriteError};
use std::fs::File;
use std::path::{Path, PathBuf};

/// Writes what comes in: whole runs of messages at a time, so that a program that is killed loses the last
/// second at most.
pub struct Recorder {
    path: PathBuf,
    writer: SessionWriter<File>,
    flushed_ns: i64,
}

/// What waits longer is written, nanoseconds.
const LONGEST_WAIT_NS: i64 = 1_000_000_000;

impl Recorder {
    /// Of the file at `path`, which becomes longer from now on.
    pub fn new(path: &Path, force: bool) -> Result<Self> {
        output::refuse_existing(path, force)?;
        let file = File::create(path).map_err(|error| {
            anyhow!(
                "{}: cannot write: {}. Name a file elsewhere with --session",
                path.display(),
                error.kind()
            )
        })?;
        let writer = SessionWriter::new(file).map_err(|error| output::named(error, path))?;
        Ok(Self { path: path.to_owned(), writer, flushed_ns: 0 })
    }

    /// Writes a message.
    pub fn write(&mut self, message: &Incoming) -> Result<()> {
        let Incoming { topic, message_type, data, received_ns, .. } = message;
        let written = self.writer.write(topic, message_type, *received_ns, data);
        self.done(written)?;
        if received_ns.saturating_sub(self.flushed_ns) >= LONGEST_WAIT_NS {
            self.flush(*received_ns)?;
        }
        Ok(())
    }

    /// Hands all of it to the disk.
    pub fn flush(&mut self, now_ns: i64) -> Result<()> {
        self.flushed_ns = now_ns;
        let flushed = self.writer.flush();
        self.done(flushed)
    }

    /// Writes what is left, and the index.
    pub fn finish(self) -> Result<()> {
        self.writer.finish().map_err(|error| output::named(error, &self.path))
    }

    fn done(&self, written: Result<(), WriteError>) -> Result<()> {
        written.map_err(|error| output::named(error, &self.path))
    }
}
