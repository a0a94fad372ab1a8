//! A bag of one file or several, of whatever kind.

mod files;

pub use files::is_bag;

use super::mcap::McapFile;
use super::ros1::Ros1Bag;
use super::sqlite::SqliteFile;
use super::zstd::Unzipper;
use super::{BagFile, Message, Place, zstd};
use crate::error::RecordingError;
use files::{METADATA, Magic, magic};
use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// What wrote a bag.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BagKind {
    /// MCAP.
    Mcap,
    /// ROS 2's bags in SQLite.
    Sqlite,
    /// ROS 1's bags.
    Ros1,
}

impl BagKind {
    /// Its name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mcap => "MCAP",
            Self::Sqlite => "rosbag2 (SQLite)",
            Self::Ros1 => "ROS 1 bag",
        }
    }
}

/// Where a message lies: which file, and where in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(test, derive(Default))]
pub(crate) struct Locator {
    file: u32,
    place: Place,
}

impl Locator {
    /// Number of the file among those of the bag.
    pub(crate) fn file(self) -> u32 {
        self.file
    }

    /// Where in its file.
    #[cfg(test)]
    pub(super) fn place(self) -> Place {
        self.place
    }
}

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
        let paths = files::of_bag(path)?;
        let mut bag =
            Self { files: Vec::new(), kind: BagKind::Mcap, metadata: None, _unzipped: Vec::new() };
        for path in &paths {
            bag.add(path, scratch)?;
        }
        if bag.files.is_empty() {
            let problem = format!("no bag is in it, or listed in its {METADATA}");
            let remedy = "Give the folder or file that was recorded";
            return Err(RecordingError::invalid(path, "bag", problem, remedy));
        }
        Ok(bag)
    }

    fn add(&mut self, path: &Path, scratch: &Path) -> Result<(), RecordingError> {
        let file = if magic(path) == Some(Magic::Zstd) {
            let unzipped = zstd::unzip_file(path, scratch, zstd::FILE_LIMIT)?;
            let file = self.file(unzipped.path()).map_err(|error| error.told_of(path))?;
            self._unzipped.push(unzipped);
            file
        } else {
            self.file(path)?
        };
        self.files.push((file, path.to_path_buf()));
        Ok(())
    }

    /// The bag at `path`, which is not compressed as a whole.
    fn file(&mut self, path: &Path) -> Result<Box<dyn BagFile>, RecordingError> {
        let Some(Magic::Bag(kind)) = magic(path) else {
            // Reading it tells whether it is there at all.
            File::open(path).map_err(|cause| RecordingError::unreadable_bag(path, cause))?;
            let problem = "the file is neither MCAP nor SQLite nor a ROS 1 bag";
            let remedy = "Give a bag, or a folder with a recording.toml";
            return Err(RecordingError::invalid(path, "kind of file", problem, remedy));
        };
        self.kind = kind;
        let file: Box<dyn BagFile> = match kind {
            BagKind::Mcap => Box::new(McapFile::open(path)?),
            BagKind::Sqlite => Box::new(SqliteFile::open(path)?),
            BagKind::Ros1 => Box::new(Ros1Bag::open(path)?),
        };
        self.metadata = file.metadata(crate::METADATA_NAME)?.or(self.metadata.take());
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
                let locator = Locator { file: number, place: message.place };
                if !zipped(message.data) {
                    return each(locator, message);
                }
                match unzipper.unzip(message.data, None) {
                    Ok(data) => each(locator, &Message { data, ..*message }),
                    Err(problem) => {
                        let time_s = message.log_time_ns as f64 * 1e-9;
                        let field = format!("{} of {time_s:.3} s", message.topic.name);
                        let remedy = "Copy the bag again, or give --partial to go without it";
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
        let file = self.files.get(locator.file as usize);
        let (file, path) = file.expect("a locator is of the bag that told it");
        let data = file.read(locator.place).map_err(|error| error.told_of(path))?;
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

/// Whether a message is compressed by itself, as ROS 2 does it on demand in any kind of file.
fn zipped(data: &[u8]) -> bool {
    data.starts_with(&zstd::MAGIC)
}
