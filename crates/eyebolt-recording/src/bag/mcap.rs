//! MCAP, as ROS 2 and many others write it. Format: <https://mcap.dev/spec>.
//!
//! Read from the beginning to the end without the index, so that a file whose recorder was killed is
//! read as far as it goes. Records that tell nothing of messages are passed over unread.

mod chunk;
mod fault;
mod fields;
mod framing;
mod records;
mod summary;

pub(crate) use framing::MAGIC;

use super::bag_file::BagFile;
use super::bytes::Bytes;
use super::cache::ChunkCache;
use super::message::{Location, Message};
use crate::error::RecordingError;
use chunk::Unpacker;
use fault::{cut_short, damaged};
use framing::{Damage, FRAMING, RecordHead, Records};
use records::Topics;
use std::collections::BTreeMap;
use std::io::Read;
use summary::summarised;

/// A file in MCAP.
#[derive(Debug)]
pub(crate) struct McapFile {
    bytes: Bytes,
    cache: ChunkCache,
}

/// How far a file that is still being written was read.
#[derive(Debug, Default)]
pub(super) struct Reached {
    topics: Topics,
    /// Where the first record starts that was not whole; 0 before anything was read.
    at: u64,
}

const CHANGED: &str = "the chunk has changed since the scan";

impl McapFile {
    /// Of these bytes, which are looked at when the file is scanned.
    pub(crate) fn new(bytes: Bytes) -> Self {
        Self { bytes, cache: ChunkCache::default() }
    }
}

impl BagFile for McapFile {
    fn scan(
        &self,
        each: &mut dyn FnMut(&Message<'_>) -> Result<(), RecordingError>,
        damage: &mut Damage<'_>,
    ) -> Result<(), RecordingError> {
        let records = Records::all(&self.bytes)?;
        let mut topics = summarised(&self.bytes);
        self.scan_records(records, &mut topics, each, damage).map(drop)
    }

    /// The metadata record called `name`, the last one where there are several.
    ///
    /// Damage is passed over: whoever scans the messages hears of it.
    fn metadata(&self, name: &str) -> Result<Option<BTreeMap<String, String>>, RecordingError> {
        let mut found = None;
        let mut visit = |_: RecordHead, body: &[u8]| {
            found = records::metadata(body, name).ok().flatten().or(found.take());
            Ok(())
        };
        let opcodes = [mcap::records::op::METADATA];
        Records::all(&self.bytes)?.visit(&opcodes, &mut visit, &mut |_| Ok(()))?;
        Ok(found)
    }

    fn read(&self, place: Location) -> Result<Vec<u8>, RecordingError> {
        let damaged = |at, problem| damaged(&self.bytes, at, problem);
        match place {
            Location::Bytes { start, length } => {
                let mut bytes = Vec::new();
                let read = self.bytes.reader(start).take(u64::from(length)).read_to_end(&mut bytes);
                match read.map_err(|cause| self.bytes.unreadable(cause))? == length as usize {
                    true => Ok(bytes),
                    false => Err(cut_short(&self.bytes, start)),
                }
            }
            Location::InChunk { chunk, start, length } => {
                let records = self.cache.get(chunk, || self.unpacked(chunk))?;
                let end = (start as usize).saturating_add(length as usize);
                let message = records.get(start as usize..end).map(<[u8]>::to_vec);
                message.ok_or_else(|| damaged(chunk, CHANGED))
            }
            Location::Row(_) => Err(damaged(0, "a row was asked for")),
        }
    }
}

impl McapFile {
    /// As [`BagFile::scan`], of what is whole by now behind what was `reached`.
    pub(super) fn scan_on(
        &self,
        reached: &mut Reached,
        each: &mut dyn FnMut(&Message<'_>) -> Result<(), RecordingError>,
    ) -> Result<(), RecordingError> {
        let records = match reached.at {
            0 => Records::all(&self.bytes)?,
            at => Records::from(&self.bytes, at),
        };
        let mut unless_unfinished = |error| match error {
            RecordingError::CutShort { .. } => Ok(()),
            error => Err(error),
        };
        let topics = &mut reached.topics;
        reached.at = self.scan_records(records, topics, each, &mut unless_unfinished)?;
        Ok(())
    }

    /// As [`BagFile::scan`], of `records`, with `topics` met before them; where the first record starts that is
    /// not whole, or where there are no more.
    fn scan_records(
        &self,
        mut records: Records<'_>,
        topics: &mut Topics,
        each: &mut dyn FnMut(&Message<'_>) -> Result<(), RecordingError>,
        damage: &mut Damage<'_>,
    ) -> Result<u64, RecordingError> {
        use mcap::records::op::{CHANNEL, CHUNK, MESSAGE, SCHEMA};
        let mut unpacker = Unpacker::default();
        let damage = std::cell::RefCell::new(damage);
        let mut visit = |head: RecordHead, body: &[u8]| {
            let damaged = |problem: String| damaged(&self.bytes, head.at, problem);
            if head.opcode != CHUNK {
                let in_body =
                    |start, length| Location::Bytes { start: head.at + FRAMING + start, length };
                let visited = topics.record(head.opcode, body, &in_body, each, &damaged);
                return records::or_damage(visited, *damage.borrow_mut());
            }
            let unpacked = unpacker.unpack(body).map_err(damaged);
            let records = match unpacked {
                Ok(records) => records,
                Err(error) => return (*damage.borrow_mut())(error),
            };
            for record in chunk::records(records) {
                let visited = match record {
                    Ok((opcode, start, body)) => {
                        let place = |behind: u64, length| Location::InChunk {
                            chunk: head.at,
                            start: start + behind as u32,
                            length,
                        };
                        topics.record(opcode, body, &place, each, &damaged)
                    }
                    Err(problem) => Err(records::Stop::Damage(damaged(problem))),
                };
                records::or_damage(visited, *damage.borrow_mut())?;
            }
            Ok(())
        };
        let mut outer = |error| (*damage.borrow_mut())(error);
        records.visit(&[SCHEMA, CHANNEL, MESSAGE, CHUNK], &mut visit, &mut outer)?;
        Ok(records.at())
    }

    /// The records of the chunk at byte `at`.
    fn unpacked(&self, at: u64) -> Result<Vec<u8>, RecordingError> {
        let mut records = Records::from(&self.bytes, at);
        let head = records.head()?.filter(|head| head.opcode == mcap::records::op::CHUNK);
        let head = head.ok_or_else(|| damaged(&self.bytes, at, CHANGED))?;
        let mut body = Vec::new();
        records.body(head, &mut body)?;
        let mut unpacker = Unpacker::default();
        unpacker.unpack(&body).map_err(|problem| damaged(&self.bytes, at, problem))?;
        // What was stored without compression lies in the body.
        Ok(unpacker.into_records(&body))
    }
}
