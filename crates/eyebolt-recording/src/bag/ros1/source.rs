//! A file with a place in it, read record by record.

use super::buffer::read_up_to;
use super::fault::Fault;
use crate::bag::bytes::{Bytes, BytesReader};
use crate::error::RecordingError;
use std::io::{self, BufRead, BufReader, Read};

/// Largest header of a record, bytes. They have five short fields at most.
const LARGEST_HEADER: u64 = 64 << 10;

/// Bytes that are read at once.
const READ_AHEAD: usize = 64 << 10;

/// The file, and where in it the next byte comes from.
pub(super) struct Source<'b> {
    bytes: &'b Bytes,
    reader: BufReader<BytesReader<'b>>,
    at: u64,
    end: u64,
}

/// Where a record of a file has its data.
#[derive(Clone, Copy, Debug)]
pub(super) struct Record {
    /// First byte of the data.
    pub(super) data: u64,
    /// How many the record says there are.
    pub(super) length: u32,
}

impl Record {
    /// First byte behind the record.
    pub(super) fn end(self) -> u64 {
        self.data.saturating_add(u64::from(self.length))
    }
}

impl<'b> Source<'b> {
    /// From the first byte on.
    pub(super) fn new(bytes: &'b Bytes) -> Self {
        let reader = BufReader::with_capacity(READ_AHEAD, bytes.reader(0));
        Self { bytes, reader, at: 0, end: bytes.length() }
    }

    /// Where the next byte comes from.
    pub(super) fn at(&self) -> u64 {
        self.at
    }

    /// The length of the file.
    pub(super) fn end(&self) -> u64 {
        self.end
    }

    /// Goes to a byte, or to the end of the file if that comes first.
    pub(super) fn seek(&mut self, to: u64) -> Result<(), RecordingError> {
        let to = to.min(self.end);
        // No file has 2^63 bytes, so that the difference has its sign. What was read ahead stays.
        let distance = to.wrapping_sub(self.at).cast_signed();
        self.reader.seek_relative(distance).map_err(|cause| self.bytes.unreadable(cause))?;
        self.at = to;
        Ok(())
    }

    /// Reads the header of the record that is here and has to end at byte `limit`, and stops at
    /// its data. Whether the data fit too is for the caller to see.
    pub(super) fn record(&mut self, limit: u64, header: &mut Vec<u8>) -> Result<Record, Fault> {
        let length = self.length(limit)?;
        if length == 0 {
            return Err("its header is empty".into());
        }
        if length > LARGEST_HEADER {
            return Err(format!("a header of {length} bytes is longer than any").into());
        }
        if length > self.before(limit) {
            return Err(self.ends_in_header(limit));
        }
        self.fill(header, length)?;
        let length = self.length(limit)?;
        Ok(Record { data: self.at, length: u32::try_from(length).unwrap_or(u32::MAX) })
    }

    /// Replaces what is in `buffer` by the next `length` bytes.
    pub(super) fn fill(&mut self, buffer: &mut Vec<u8>, length: u64) -> Result<(), RecordingError> {
        let bytes = self.bytes;
        read_up_to(self, buffer, length).map_err(|cause| bytes.unreadable(cause))?;
        if (buffer.len() as u64) < length {
            // It was longer when it was opened.
            return Err(bytes.unreadable(io::ErrorKind::UnexpectedEof.into()));
        }
        Ok(())
    }

    /// That a record does not end by byte `limit`, which is the file's end or that of a chunk.
    pub(super) fn cut(&self, record: Record, limit: u64) -> Fault {
        if limit < self.end {
            return "it goes on behind the end of its chunk".into();
        }
        let missing = record.end().saturating_sub(self.end);
        Fault::cut(format!("the file ends {missing} bytes before the record does"))
    }

    fn ends_in_header(&self, limit: u64) -> Fault {
        if limit < self.end {
            return "its chunk ends in its header".into();
        }
        Fault::cut("the file ends in its header")
    }

    /// Bytes between here and `limit`, or the end of the file if that comes first.
    fn before(&self, limit: u64) -> u64 {
        limit.min(self.end).saturating_sub(self.at)
    }

    fn length(&mut self, limit: u64) -> Result<u64, Fault> {
        let mut bytes = [0; 4];
        if self.before(limit) < 4 {
            return Err(self.ends_in_header(limit));
        }
        self.read_exact(&mut bytes).map_err(|cause| self.bytes.unreadable(cause))?;
        Ok(u64::from(u32::from_le_bytes(bytes)))
    }
}

impl Read for Source<'_> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let count = self.reader.read(into)?;
        self.at = self.at.saturating_add(count as u64);
        Ok(count)
    }
}

impl BufRead for Source<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        self.reader.fill_buf()
    }

    fn consume(&mut self, count: usize) {
        self.reader.consume(count);
        self.at = self.at.saturating_add(count as u64);
    }
}
