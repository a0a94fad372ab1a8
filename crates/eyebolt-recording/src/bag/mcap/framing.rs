//! Records of a file one after the other: an opcode, a length and a body each.

use super::fault::{cut_short, damaged};
use crate::bag::bag_file::LARGEST_CHUNK;
use crate::bag::bytes::{Bytes, BytesReader};
use crate::error::RecordingError;
use std::io::{BufReader, Read, Seek, SeekFrom};

/// The first bytes of a file, and its last.
pub(crate) const MAGIC: [u8; 8] = *b"\x89MCAP0\r\n";

/// Bytes of the opcode and the length before every record.
pub(super) const FRAMING: u64 = 9;

/// Bytes that are read at once by whoever reads all records.
const READ_AHEAD: usize = 1 << 20;

/// A record of the file.
#[derive(Clone, Copy, Debug)]
pub(super) struct RecordHead {
    pub(super) opcode: u8,
    /// Where it starts.
    pub(super) at: u64,
    /// Bytes behind the framing.
    pub(super) length: u64,
}

/// What is done with records.
pub(super) type Visit<'a> = dyn FnMut(RecordHead, &[u8]) -> Result<(), RecordingError> + 'a;
/// What is asked about damaged ones.
pub(super) type Damage<'a> = dyn FnMut(RecordingError) -> Result<(), RecordingError> + 'a;

/// Records, and where the next one starts.
pub(super) struct Records<'b> {
    bytes: &'b Bytes,
    reader: BufReader<BytesReader<'b>>,
    at: u64,
}

impl<'b> Records<'b> {
    /// From the first one on, if the file begins as MCAP.
    pub(super) fn all(bytes: &'b Bytes) -> Result<Self, RecordingError> {
        let mut reader = BufReader::with_capacity(READ_AHEAD, bytes.reader(0));
        let mut magic = [0; MAGIC.len()];
        let read = reader.read_exact(&mut magic);
        if read.is_err() || magic != MAGIC {
            let remedy = "Give the file that `ros2 bag record -s mcap` wrote";
            let problem = "the file is not MCAP";
            return Err(RecordingError::invalid(bytes.path(), "magic", problem, remedy));
        }
        Ok(Self { bytes, reader, at: MAGIC.len() as u64 })
    }

    /// From the one at byte `at` on.
    pub(super) fn from(bytes: &'b Bytes, at: u64) -> Self {
        Self { bytes, reader: BufReader::new(bytes.reader(at)), at }
    }

    /// The framing of the next record; `None` at the end of what holds messages.
    pub(super) fn head(&mut self) -> Result<Option<RecordHead>, RecordingError> {
        let at = self.at;
        let left = self.bytes.length().saturating_sub(at);
        if left < FRAMING {
            return Err(cut_short(self.bytes, at));
        }
        let mut framing = [0; FRAMING as usize];
        self.reader.read_exact(&mut framing).map_err(|cause| self.bytes.unreadable(cause))?;
        let [opcode, length @ ..] = framing;
        let length = u64::from_le_bytes(length);
        if matches!(opcode, mcap::records::op::DATA_END | mcap::records::op::FOOTER) {
            return Ok(None);
        }
        if length > left - FRAMING {
            return Err(cut_short(self.bytes, at));
        }
        Ok(Some(RecordHead { opcode, at, length }))
    }

    /// The body of the record whose framing was read last, into `body`, which is used again and
    /// again.
    pub(super) fn body(
        &mut self,
        head: RecordHead,
        body: &mut Vec<u8>,
    ) -> Result<(), RecordingError> {
        if head.length > LARGEST_CHUNK {
            let problem = format!("{} bytes, more than {} MiB", head.length, LARGEST_CHUNK >> 20);
            return Err(damaged(self.bytes, head.at, problem));
        }
        body.clear();
        // The length has been compared with the file's.
        let read = self.reader.by_ref().take(head.length).read_to_end(body);
        match read.map_err(|cause| self.bytes.unreadable(cause))? as u64 == head.length {
            true => Ok(()),
            false => Err(cut_short(self.bytes, head.at)),
        }
    }

    /// Where the next record starts.
    pub(super) fn at(&self) -> u64 {
        self.at
    }

    /// Hands the records with one of `opcodes` before the summary to `visit`. At the end, [`Self::at`] is
    /// where the first record starts that is not whole, if there is one.
    pub(super) fn visit(
        &mut self,
        opcodes: &[u8],
        visit: &mut Visit<'_>,
        damage: &mut Damage<'_>,
    ) -> Result<(), RecordingError> {
        let mut body = Vec::new();
        loop {
            let head = match self.head() {
                Ok(Some(head)) => head,
                Ok(None) => return Ok(()),
                Err(error) => return damage(error),
            };
            self.at += FRAMING + head.length;
            if !opcodes.contains(&head.opcode) {
                // At most what the file has: an offset that fits.
                let skipped = i64::try_from(head.length).unwrap_or(i64::MAX);
                let skipped = self.reader.seek_relative(skipped);
                skipped.map_err(|cause| self.bytes.unreadable(cause))?;
            } else if let Err(error) = self.body(head, &mut body) {
                damage(error)?;
                let behind = self.reader.seek(SeekFrom::Start(self.at));
                behind.map_err(|cause| self.bytes.unreadable(cause))?;
            } else {
                visit(head, &body)?;
            }
        }
    }
}
