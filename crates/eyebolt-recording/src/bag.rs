//! Bags: files of messages with time stamps, whatever wrote them.

mod cache;
mod mcap;
mod open;
mod ros1;
mod sqlite;
#[cfg(test)]
mod tests;
mod zstd;

pub(crate) use open::{Bag, Locator};
pub use open::{BagKind, is_bag};

use crate::error::RecordingError;
use std::collections::BTreeMap;

/// A stream of messages of one type.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Topic {
    /// As in `/camera/depth/image_raw`.
    pub(crate) name: String,
    /// Type of its messages without ROS 2's `msg`, as in `sensor_msgs/Image`.
    pub(crate) message_type: String,
    /// How its messages are written.
    pub(crate) encoding: Encoding,
}

/// How messages are written as bytes.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Encoding {
    /// ROS 2: OMG's Common Data Representation behind four bytes that tell its byte order.
    Cdr,
    /// ROS 1.
    Ros1,
    /// By another rule, of this name.
    Other(String),
}

/// One message, as a scan comes by.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Message<'a> {
    /// What it belongs to.
    pub(crate) topic: &'a Topic,
    /// Number of the topic in its file, from 0 without gaps; the same for every message of the topic.
    pub(crate) topic_index: usize,
    /// When it was written down, nanoseconds.
    pub(crate) log_time_ns: i64,
    /// Where to find it again.
    pub(crate) place: Place,
    /// Its bytes, decompressed.
    pub(crate) data: &'a [u8],
}

/// Where a message lies in its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// At a byte of the file, not in a chunk.
    Bytes {
        /// The first byte of the message's data, from the beginning of the file.
        start: u64,
        /// How many.
        length: u32,
    },
    /// In a chunk, compressed or not.
    InChunk {
        /// Offset in the file of the record that is the chunk.
        chunk: u64,
        /// The first byte of the message's data in the decompressed chunk.
        start: u32,
        /// How many.
        length: u32,
    },
    /// In a row of a table.
    Row(i64),
}

#[cfg(test)]
impl Default for Place {
    fn default() -> Self {
        Self::Row(0)
    }
}

/// A file of messages.
///
/// Reading is by streaming: memory holds one chunk (or message) at a time, however long the file.
pub(crate) trait BagFile: std::fmt::Debug + Send + Sync {
    /// Hands every message to `each`, in the order of the file; an error of `each` ends the scan.
    ///
    /// `damage` is asked what to do about a part that cannot be read: the error that it returns
    /// ends the scan; `Ok` goes on behind that part (at the end of the file, the scan is over).
    fn scan(
        &self,
        each: &mut dyn FnMut(&Message<'_>) -> Result<(), RecordingError>,
        damage: &mut dyn FnMut(RecordingError) -> Result<(), RecordingError>,
    ) -> Result<(), RecordingError>;

    /// The metadata record called `name`, in files of a kind that has such.
    fn metadata(&self, _name: &str) -> Result<Option<BTreeMap<String, String>>, RecordingError> {
        Ok(None)
    }

    /// The bytes of the message at `place`, which a scan of this file told.
    fn read(&self, place: Place) -> Result<Vec<u8>, RecordingError>;
}

/// No message, and no chunk of messages, is larger than this when decompressed, bytes: a cloud of
/// 4K with 32 bytes a point. A reader may have three of them in memory: a chunk, a message out of
/// it, and what that becomes.
pub(crate) const LARGEST_CHUNK: u64 = 256 << 20;

/// The type's name without ROS 2's `msg`.
pub(crate) fn ros_type(name: &str) -> String {
    name.replacen("/msg/", "/", 1)
}
