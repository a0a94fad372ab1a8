//! What wrote a bag, by its first bytes.

use super::{mcap, sqlite, zstd};
use std::io::{self, Read};

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

/// What a file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Magic {
    /// A bag.
    Bag(BagKind),
    /// Something that is compressed as a whole.
    Zstd,
}

/// Bytes that are enough to tell.
const ENOUGH: u64 = 16;

/// What the first bytes, which are next in `reader`, tell; `None` if it is no bag.
pub(super) fn magic(reader: impl Read) -> io::Result<Option<Magic>> {
    let mut bytes = Vec::new();
    reader.take(ENOUGH).read_to_end(&mut bytes)?;
    let known = if bytes.starts_with(&mcap::MAGIC) {
        Magic::Bag(BagKind::Mcap)
    } else if bytes.starts_with(sqlite::FILE_MAGIC) {
        Magic::Bag(BagKind::Sqlite)
    } else if bytes.starts_with(b"#ROSBAG V") {
        Magic::Bag(BagKind::Ros1)
    } else if bytes.starts_with(&zstd::MAGIC) {
        Magic::Zstd
    } else {
        return Ok(None);
    };
    Ok(Some(known))
}
