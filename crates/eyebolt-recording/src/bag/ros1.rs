//! Bags of ROS 1, format 2.0.
//!
//! The format is told at <http://wiki.ros.org/Bags/Format/2.0>. A file is read from its beginning
//! to its end whatever its index says, so that what a killed recorder left (`.bag.active`, without
//! an index) is read like any other. The index only helps out where a chunk is corrupt.

mod buffer;
mod chunk;
mod connections;
mod contents;
mod fault;
mod header;
mod scan;
mod source;
#[cfg(test)]
mod tests;

use super::bag_file::{BagFile, LARGEST_CHUNK};
use super::bytes::Bytes;
use super::cache::ChunkCache;
use super::message::{Location, Message};
use crate::error::RecordingError;
use chunk::Chunk;
use fault::{Fault, Taker};
use header::{Header, Op};
use scan::Scan;
use source::Source;
use std::sync::Arc;

const MAGIC: &[u8] = b"#ROSBAG V2.0\n";

/// A file of a ROS 1 recorder.
#[derive(Debug)]
pub(crate) struct Ros1Bag {
    bytes: Bytes,
    cache: ChunkCache,
}

impl Ros1Bag {
    /// The bag of these bytes. Errors if they cannot be read or do not begin as one.
    pub(crate) fn new(bytes: Bytes) -> Result<Self, RecordingError> {
        let mut source = Source::new(&bytes);
        let mut magic = Vec::new();
        let length = source.end().min(MAGIC.len() as u64);
        source.fill(&mut magic, length)?;
        if magic == MAGIC {
            return Ok(Self { bytes, cache: ChunkCache::default() });
        }
        let invalid = |problem: &str, remedy| {
            Err(RecordingError::invalid(bytes.path(), "the first line", problem, remedy))
        };
        match magic.strip_prefix(b"#ROSBAG V").and_then(|rest| rest.strip_suffix(b"\n")) {
            Some(version) => invalid(
                &format!("version {} of bags is not read", version.escape_ascii()),
                "Convert it to version 2.0 with `rosbag reindex`",
            ),
            None => invalid("it is not `#ROSBAG V2.0`", "Name a file that ROS 1 recorded"),
        }
    }

    fn read_bytes(&self, start: u64, length: u32) -> Result<Vec<u8>, Fault> {
        let mut source = Source::new(&self.bytes);
        let length = u64::from(length);
        if length > LARGEST_CHUNK || start.saturating_add(length) > source.end() {
            return Err("it is not in the file".into());
        }
        source.seek(start)?;
        let mut bytes = Vec::new();
        source.fill(&mut bytes, length)?;
        Ok(bytes)
    }

    fn read_from_chunk(&self, chunk: u64, start: u32, length: u32) -> Result<Vec<u8>, Fault> {
        let start = usize::try_from(start).unwrap_or(usize::MAX);
        let end = start.saturating_add(usize::try_from(length).unwrap_or(usize::MAX));
        match Arc::try_unwrap(self.cache.get(chunk, || self.decompress(chunk))?) {
            Err(kept) => Ok(kept.get(start..end).ok_or("it is not in its chunk")?.to_vec()),
            // Nobody else wants the chunk, which is large: its memory becomes the message's.
            Ok(mut bytes) if end <= bytes.len() => {
                bytes.truncate(end);
                bytes.drain(..start);
                bytes.shrink_to_fit();
                Ok(bytes)
            }
            Ok(_) => Err("it is not in its chunk".into()),
        }
    }

    /// The contents of the chunk whose record begins at byte `chunk`.
    fn decompress(&self, chunk: u64) -> Result<Vec<u8>, Fault> {
        let mut source = Source::new(&self.bytes);
        source.seek(chunk)?;
        let (mut header, mut bytes) = (Vec::new(), Vec::new());
        let end = source.end();
        let record = source.record(end, &mut header)?;
        let header = Header::parse(&header)?;
        if header.op()? != Op::Chunk {
            return Err("it is not a chunk".into());
        }
        Chunk::parse(header)?.decompress(&mut source, record, &mut bytes)?;
        Ok(bytes)
    }
}

impl BagFile for Ros1Bag {
    fn scan(
        &self,
        each: &mut dyn FnMut(&Message<'_>) -> Result<(), RecordingError>,
        damage: &mut dyn FnMut(RecordingError) -> Result<(), RecordingError>,
    ) -> Result<(), RecordingError> {
        Scan::new(&self.bytes, MAGIC.len() as u64)?.run(&mut Taker { each, damage })
    }

    fn read(&self, place: Location) -> Result<Vec<u8>, RecordingError> {
        match place {
            Location::Bytes { start, length } => self
                .read_bytes(start, length)
                .map_err(|fault| fault.at(self.bytes.path(), format!("message at byte {start}"))),
            Location::InChunk { chunk, start, length } => {
                self.read_from_chunk(chunk, start, length).map_err(|fault| {
                    let field = format!("message at byte {start} of the chunk at byte {chunk}");
                    fault.at(self.bytes.path(), field)
                })
            }
            Location::Row(row) => Err(RecordingError::invalid(
                self.bytes.path(),
                format!("message of row {row}"),
                "a bag of ROS 1 has no rows",
                "Scan the file for its messages",
            )),
        }
    }
}
