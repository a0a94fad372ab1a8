//! The bytes of one file of a bag, wherever they come from.

use crate::error::RecordingError;
use std::fmt;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// What a bag can be read from.
pub(crate) trait ReadSeek: Read + Seek + Send {}

impl<T: Read + Seek + Send> ReadSeek for T {}

/// The bytes of a file that was opened once, for several readers at the same time.
#[derive(Debug)]
pub(crate) struct Bytes {
    path: PathBuf,
    length: u64,
    store: Store,
    in_file: bool,
}

enum Store {
    /// Read at any place, by any number of threads.
    #[cfg(unix)]
    File(File),
    /// Read by turns. A turn copies bytes and no more: what is decompressed is so outside of it.
    Shared(Mutex<Box<dyn ReadSeek>>),
}

impl Bytes {
    /// Of the file at `path`.
    pub(crate) fn open(path: &Path) -> Result<Self, RecordingError> {
        let failed = |cause| RecordingError::unreadable_bag(path, cause);
        let file = File::open(path).map_err(failed)?;
        let length = file.metadata().map_err(failed)?.len();
        #[cfg(unix)]
        let store = Store::File(file);
        #[cfg(not(unix))]
        let store = Store::Shared(Mutex::new(Box::new(file)));
        Ok(Self { path: path.to_path_buf(), length, store, in_file: true })
    }

    /// Of whatever `reader` reads, which errors call `name`.
    pub(crate) fn from_reader(
        name: &Path,
        mut reader: impl ReadSeek + 'static,
    ) -> Result<Self, RecordingError> {
        let end = reader.seek(SeekFrom::End(0));
        let length = end.map_err(|cause| RecordingError::unreadable_bag(name, cause))?;
        let store = Store::Shared(Mutex::new(Box::new(reader)));
        Ok(Self { path: name.to_path_buf(), length, store, in_file: false })
    }

    /// Where the file is, or what it is called.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// The file's path, for a library that opens files by itself; `None` of what is no file.
    pub(crate) fn into_file_path(self) -> Option<PathBuf> {
        self.in_file.then_some(self.path)
    }

    /// How many there were when the file was opened.
    pub(crate) fn length(&self) -> u64 {
        self.length
    }

    /// Reads from byte `at` on.
    pub(crate) fn reader(&self, at: u64) -> BytesReader<'_> {
        BytesReader { bytes: self, at }
    }

    /// That they cannot be read.
    pub(crate) fn unreadable(&self, cause: io::Error) -> RecordingError {
        RecordingError::unreadable_bag(&self.path, cause)
    }

    fn read_at(&self, at: u64, into: &mut [u8]) -> io::Result<usize> {
        match &self.store {
            #[cfg(unix)]
            Store::File(file) => std::os::unix::fs::FileExt::read_at(file, into, at),
            Store::Shared(reader) => {
                // Every turn begins by going to its place, so that no panic leaves a wrong one.
                let mut reader = reader.lock().unwrap_or_else(PoisonError::into_inner);
                reader.seek(SeekFrom::Start(at))?;
                reader.read(into)
            }
        }
    }
}

impl fmt::Debug for Store {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            #[cfg(unix)]
            Self::File(file) => file.fmt(f),
            Self::Shared(_) => f.write_str("a shared reader"),
        }
    }
}

/// A reader with a place of its own.
#[derive(Clone, Debug)]
pub(crate) struct BytesReader<'b> {
    bytes: &'b Bytes,
    at: u64,
}

impl Read for BytesReader<'_> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let count = self.bytes.read_at(self.at, into)?;
        self.at = self.at.saturating_add(count as u64);
        Ok(count)
    }
}

impl Seek for BytesReader<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let place = match to {
            SeekFrom::Start(at) => Some(at),
            SeekFrom::Current(by) => self.at.checked_add_signed(by),
            SeekFrom::End(by) => self.bytes.length.checked_add_signed(by),
        };
        self.at = place.ok_or(io::ErrorKind::InvalidInput)?;
        Ok(self.at)
    }
}
