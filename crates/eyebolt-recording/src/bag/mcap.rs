//! MCAP, as ROS 2 and many others write it. Format: <https://mcap.dev/spec>.
//!
//! Read from the beginning to the end without the index, so that a file whose recorder was killed is
//! read as far as it goes. Records that tell nothing of messages are passed over unread.

mod chunk;
mod fields;
mod records;
mod summary;

use super::cache::ChunkCache;
use super::{BagFile, LARGEST_CHUNK, Message, Place};
use crate::error::RecordingError;
use chunk::Unpacker;
use records::after_magic;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// The first bytes of a file, and its last.
pub(super) const MAGIC: [u8; 8] = *b"\x89MCAP0\r\n";

/// Bytes of the opcode and the length before every record.
const FRAMING: u64 = 9;

/// A file in MCAP.
#[derive(Debug)]
pub(crate) struct McapFile {
    path: PathBuf,
    length: u64,
    cache: ChunkCache,
}

/// A record of the file.
#[derive(Clone, Copy, Debug)]
struct RecordHead {
    opcode: u8,
    /// Where it starts.
    at: u64,
    /// Bytes behind the framing.
    length: u64,
}

/// What is done with records.
type Visit<'a> = dyn FnMut(RecordHead, &[u8]) -> Result<(), RecordingError> + 'a;
/// What is asked about damaged ones.
type Damage<'a> = dyn FnMut(RecordingError) -> Result<(), RecordingError> + 'a;

impl McapFile {
    pub(crate) fn open(path: &Path) -> Result<Self, RecordingError> {
        let file = Self { path: path.to_path_buf(), length: 0, cache: ChunkCache::default() };
        let handle = File::open(path).map_err(|cause| file.unreadable(cause))?;
        let length = handle.metadata().map_err(|cause| file.unreadable(cause))?.len();
        Ok(Self { length, ..file })
    }

    fn unreadable(&self, cause: std::io::Error) -> RecordingError {
        RecordingError::unreadable_bag(&self.path, cause)
    }

    fn damaged(&self, at: u64, problem: impl Into<String>) -> RecordingError {
        let remedy = "The file is damaged: copy it again, repair it with `mcap recover`, or give \
                      --partial to use what can be read";
        RecordingError::invalid(&self.path, format!("record at byte {at}"), problem, remedy)
    }

    fn cut_short(&self, at: u64) -> RecordingError {
        let problem = "the file ends in the middle of it, as when a recorder is killed";
        let remedy = "Repair it with `mcap recover`, or give --partial to use what is before";
        RecordingError::invalid(&self.path, format!("record at byte {at}"), problem, remedy)
    }

    /// The next record; `None` at the end of what holds messages.
    fn head(
        &self,
        reader: &mut BufReader<File>,
        at: u64,
    ) -> Result<Option<RecordHead>, RecordingError> {
        let left = self.length.saturating_sub(at);
        if left < FRAMING {
            return Err(self.cut_short(at));
        }
        let mut bytes = [0; FRAMING as usize];
        reader.read_exact(&mut bytes).map_err(|cause| self.unreadable(cause))?;
        let [opcode, length @ ..] = bytes;
        let length = u64::from_le_bytes(length);
        if matches!(opcode, mcap::records::op::DATA_END | mcap::records::op::FOOTER) {
            return Ok(None);
        }
        if length > left - FRAMING {
            return Err(self.cut_short(at));
        }
        Ok(Some(RecordHead { opcode, at, length }))
    }

    /// The body of a record into `body`, which is used again and again.
    fn body(
        &self,
        reader: &mut BufReader<File>,
        head: RecordHead,
        body: &mut Vec<u8>,
    ) -> Result<(), RecordingError> {
        if head.length > LARGEST_CHUNK {
            let problem = format!("{} bytes, more than {} MiB", head.length, LARGEST_CHUNK >> 20);
            return Err(self.damaged(head.at, problem));
        }
        body.clear();
        // The length has been compared with the file's.
        let read = reader.by_ref().take(head.length).read_to_end(body);
        match read.map_err(|cause| self.unreadable(cause))? as u64 == head.length {
            true => Ok(()),
            false => Err(self.cut_short(head.at)),
        }
    }

    /// Hands the records with one of `opcodes` before the summary to `visit`.
    fn records(
        &self,
        opcodes: &[u8],
        visit: &mut Visit<'_>,
        damage: &mut Damage<'_>,
    ) -> Result<(), RecordingError> {
        let file = File::open(&self.path).map_err(|cause| self.unreadable(cause))?;
        let mut reader = BufReader::with_capacity(1 << 20, file);
        let at = after_magic(&self.path, &mut reader)?;
        self.records_from(&mut reader, at, opcodes, visit, damage)
    }

    /// As [`Self::records`], from byte `at`, where the reader is.
    fn records_from(
        &self,
        reader: &mut BufReader<File>,
        mut at: u64,
        opcodes: &[u8],
        visit: &mut Visit<'_>,
        damage: &mut Damage<'_>,
    ) -> Result<(), RecordingError> {
        let mut body = Vec::new();
        loop {
            let head = match self.head(reader, at) {
                Ok(Some(head)) => head,
                Ok(None) => return Ok(()),
                Err(error) => return damage(error),
            };
            let next = at + FRAMING + head.length;
            if !opcodes.contains(&head.opcode) {
                // At most what the file has: an offset that fits.
                let skipped = i64::try_from(head.length).unwrap_or(i64::MAX);
                reader.seek_relative(skipped).map_err(|cause| self.unreadable(cause))?;
            } else if let Err(error) = self.body(reader, head, &mut body) {
                damage(error)?;
                reader.seek(SeekFrom::Start(next)).map_err(|cause| self.unreadable(cause))?;
            } else {
                visit(head, &body)?;
            }
            at = next;
        }
    }
}

impl BagFile for McapFile {
    fn scan(
        &self,
        each: &mut dyn FnMut(&Message<'_>) -> Result<(), RecordingError>,
        damage: &mut Damage<'_>,
    ) -> Result<(), RecordingError> {
        use mcap::records::op::{CHANNEL, CHUNK, MESSAGE, SCHEMA};
        let mut topics = self.summarised();
        let mut unpacker = Unpacker::default();
        let damage = std::cell::RefCell::new(damage);
        let mut visit = |head: RecordHead, body: &[u8]| {
            let damaged = |problem: String| self.damaged(head.at, problem);
            if head.opcode != CHUNK {
                let in_body =
                    |start, length| Place::Bytes { start: head.at + FRAMING + start, length };
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
                        let place = |behind: u64, length| Place::InChunk {
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
        self.records(&[SCHEMA, CHANNEL, MESSAGE, CHUNK], &mut visit, &mut outer)
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
        self.records(&[mcap::records::op::METADATA], &mut visit, &mut |_| Ok(()))?;
        Ok(found)
    }

    fn read(&self, place: Place) -> Result<Vec<u8>, RecordingError> {
        let unreadable = |cause| self.unreadable(cause);
        match place {
            Place::Bytes { start, length } => {
                let mut file = File::open(&self.path).map_err(unreadable)?;
                file.seek(SeekFrom::Start(start)).map_err(unreadable)?;
                let mut bytes = Vec::new();
                file.take(u64::from(length)).read_to_end(&mut bytes).map_err(unreadable)?;
                match bytes.len() == length as usize {
                    true => Ok(bytes),
                    false => Err(self.cut_short(start)),
                }
            }
            Place::InChunk { chunk, start, length } => {
                let records = self.cache.get(chunk, || self.unpacked(chunk))?;
                let end = (start as usize).saturating_add(length as usize);
                let message = records.get(start as usize..end).map(<[u8]>::to_vec);
                message.ok_or_else(|| self.damaged(chunk, "the chunk has changed since the scan"))
            }
            Place::Row(_) => Err(self.damaged(0, "a row was asked for")),
        }
    }
}

impl McapFile {
    /// The records of the chunk at byte `at`.
    fn unpacked(&self, at: u64) -> Result<Vec<u8>, RecordingError> {
        let unreadable = |cause| self.unreadable(cause);
        let mut file = File::open(&self.path).map_err(unreadable)?;
        file.seek(SeekFrom::Start(at)).map_err(unreadable)?;
        let mut reader = BufReader::new(file);
        let head = self.head(&mut reader, at)?;
        let Some(head) = head.filter(|head| head.opcode == mcap::records::op::CHUNK) else {
            return Err(self.damaged(at, "the chunk has changed since the scan"));
        };
        let mut body = Vec::new();
        self.body(&mut reader, head, &mut body)?;
        let mut unpacker = Unpacker::default();
        unpacker.unpack(&body).map_err(|problem| self.damaged(at, problem))?;
        // What was stored without compression lies in the body.
        Ok(unpacker.into_records(&body))
    }
}
