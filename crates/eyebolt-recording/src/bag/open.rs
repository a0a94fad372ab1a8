//! A bag of one file or several, of whatever kind.

use super::bag_file::BagFile;
use super::bytes::{Bytes, ReadSeek};
use super::files;
use super::kind::{BagKind, Magic, magic};
use super::locator::Locator;
use super::mcap::McapFile;
use super::message::Message;
use super::remedy::or_partial;
use super::ros1::Ros1Bag;
use super::sqlite::SqliteFile;
use super::zstd::{self, Unzipper};
use crate::error::RecordingError;
use crate::own_metadata;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// A bag of one file or several.
#[derive(Debug)]
pub(crate) struct Bag {
    /// Files, and the paths under which people know them.
    files: Vec<(Box<dyn BagFile>, PathBuf)>,
    kind: BagKind,
    metadata: Option<BTreeMap<String, String>>,
    /// Decompressed copies, there as long as the bag is.
    _unzipped: Vec<NamedTempFile>,
}

impl Bag {
    /// Opens the bag that `path` is, or that lies in the folder `path`. Files compressed as a whole
    /// are decompressed to the folder `scratch` for as long as the bag is open.
    pub(crate) fn open(path: &Path, scratch: &Path) -> Result<Self, RecordingError> {
        let mut bag = Self::without_files();
        for path in files::of_bag(path)? {
            bag.add(Bytes::open(&path)?, scratch)?;
        }
        if bag.files.is_empty() {
            let problem = format!("no bag is in it, or listed in its {}", files::METADATA);
            let remedy = "Give the folder or file that was recorded";
            return Err(RecordingError::invalid(path, "bag", problem, remedy));
        }
        Ok(bag)
    }

    /// The bag that `reader` reads, from its first byte to its last: MCAP or a bag of ROS 1, in
    /// memory or wherever else. Errors call it `name`. What is compressed as a whole is
    /// decompressed to the folder `scratch` for as long as the bag is open.
    ///
    /// SQLite reads files for itself, so that its bags are an error here.
    pub(crate) fn from_reader(
        name: &Path,
        reader: impl ReadSeek + 'static,
        scratch: &Path,
    ) -> Result<Self, RecordingError> {
        let mut bag = Self::without_files();
        bag.add(Bytes::from_reader(name, reader)?, scratch)?;
        Ok(bag)
    }

    fn without_files() -> Self {
        Self { files: Vec::new(), kind: BagKind::Mcap, metadata: None, _unzipped: Vec::new() }
    }

    fn add(&mut self, bytes: Bytes, scratch: &Path) -> Result<(), RecordingError> {
        let path = bytes.path().to_path_buf();
        let file = if kind(&bytes) == Some(Magic::Zstd) {
            let unzipped = zstd::unzip_file(&bytes, scratch, zstd::FILE_LIMIT)?;
            let file = self.file(Bytes::open(unzipped.path())?);
            self._unzipped.push(unzipped);
            file.map_err(|error| error.told_of(&path))?
        } else {
            self.file(bytes)?
        };
        self.files.push((file, path));
        Ok(())
    }

    /// The bag of these bytes, which is not compressed as a whole.
    fn file(&mut self, bytes: Bytes) -> Result<Box<dyn BagFile>, RecordingError> {
        let Some(Magic::Bag(kind)) = kind(&bytes) else {
            let problem = "the file is neither MCAP nor SQLite nor a ROS 1 bag";
            let remedy = "Give a bag, or a folder with a recording.toml";
            return Err(RecordingError::invalid(bytes.path(), "kind of file", problem, remedy));
        };
        self.kind = kind;
        let file: Box<dyn BagFile> = match kind {
            BagKind::Mcap => Box::new(McapFile::new(bytes)),
            BagKind::Sqlite => Box::new(SqliteFile::open(&sqlite_path(bytes)?)?),
            BagKind::Ros1 => Box::new(Ros1Bag::new(bytes)?),
        };
        self.metadata = file.metadata(own_metadata::NAME)?.or(self.metadata.take());
        Ok(file)
    }

    /// The files, under the paths by which people know them.
    pub(crate) fn sources(&self) -> impl Iterator<Item = &Path> {
        self.files.iter().map(|(_, path)| path.as_path())
    }

    pub(crate) fn kind(&self) -> BagKind {
        self.kind
    }

    /// What eyebolt wrote into the bag about itself, if it wrote the bag.
    pub(crate) fn metadata(&self) -> Option<&BTreeMap<String, String>> {
        self.metadata.as_ref()
    }

    /// The metadata record called `name`, of the last file that has one.
    pub(crate) fn record(
        &self,
        name: &str,
    ) -> Result<Option<BTreeMap<String, String>>, RecordingError> {
        let mut found = None;
        for (file, path) in &self.files {
            let record = file.metadata(name).map_err(|error| error.told_of(path))?;
            found = record.or(found);
        }
        Ok(found)
    }

    /// Hands every message with its number among the files to `each`; see [`BagFile::scan`].
    pub(crate) fn scan(
        &self,
        each: &mut dyn FnMut(Locator, &Message<'_>) -> Result<(), RecordingError>,
        damage: &mut dyn FnMut(RecordingError) -> Result<(), RecordingError>,
    ) -> Result<(), RecordingError> {
        let mut unzipper = Unzipper::default();
        let damage = std::cell::RefCell::new(damage);
        for (number, (file, path)) in (0..).zip(&self.files) {
            let damaged = |error: RecordingError| (*damage.borrow_mut())(error.told_of(path));
            let mut with_file = |message: &Message<'_>| {
                let locator = Locator::new(number, message.place);
                if !zipped(message.data) {
                    return each(locator, message);
                }
                match unzipper.unzip(message.data, None) {
                    Ok(data) => each(locator, &Message { data, ..*message }),
                    Err(problem) => {
                        let time_s = message.log_time_ns as f64 * 1e-9;
                        let field = format!("{} of {time_s:.3} s", message.topic.name);
                        let remedy = or_partial("Copy the bag again", "to go without it");
                        damaged(RecordingError::invalid(path, field, problem, remedy))
                    }
                }
            };
            file.scan(&mut with_file, &mut |error| damaged(error))
                .map_err(|error| error.told_of(path))?;
        }
        Ok(())
    }

    /// The bytes of a message.
    pub(crate) fn read(&self, locator: Locator) -> Result<Vec<u8>, RecordingError> {
        let file = self.files.get(locator.file() as usize);
        let (file, path) = file.expect("a locator is of the bag that told it");
        let data = file.read(locator.place()).map_err(|error| error.told_of(path))?;
        if !zipped(&data) {
            return Ok(data);
        }
        let mut unzipper = Unzipper::default();
        match unzipper.unzip(&data, None) {
            Ok(_) => Ok(unzipper.into_bytes()),
            Err(problem) => {
                let remedy = "The bag has changed since it was opened: open it again";
                Err(RecordingError::invalid(path, "a message", problem, remedy))
            }
        }
    }
}

/// SQLite opens files by itself.
fn sqlite_path(bytes: Bytes) -> Result<PathBuf, RecordingError> {
    let name = bytes.path().to_path_buf();
    bytes.into_file_path().ok_or_else(|| {
        let problem = "bags in SQLite are read from files only";
        RecordingError::invalid(&name, "kind of file", problem, "Give the file's path")
    })
}

/// What the first bytes tell. Bytes that cannot be read are of no kind.
fn kind(bytes: &Bytes) -> Option<Magic> {
    magic(bytes.reader(0)).ok().flatten()
}

/// Whether a message is compressed by itself, as ROS 2 does it on demand in any kind of file.
fn zipped(data: &[u8]) -> bool {
    data.starts_with(&zstd::MAGIC)
}
