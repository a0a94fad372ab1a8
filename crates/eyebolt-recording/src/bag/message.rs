//! A message of a bag, and where it lies.

use super::topic::Topic;

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
    pub(crate) place: Location,
    /// Its bytes, decompressed.
    pub(crate) data: &'a [u8],
}

/// Where a message lies in its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Location {
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
impl Default for Location {
    fn default() -> Self {
        Self::Row(0)
    }
}
