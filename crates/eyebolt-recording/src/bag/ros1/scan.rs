//! From the first record of a file to the last.

use super::chunk::{Chunk, Compression};
use super::connections::{Connections, LARGEST_CONNECTION};
use super::contents::{contents, take};
use super::fault::{Fault, Taker};
use super::header::{Header, Op};
use super::source::{Record, Source};
use crate::bag::bag_file::LARGEST_CHUNK;
use crate::bag::bytes::Bytes;
use crate::bag::message::Location;
use crate::error::RecordingError;
use std::path::Path;

/// Where a scan is, and its buffers.
pub(super) struct Scan<'b> {
    path: &'b Path,
    source: Source<'b>,
    connections: Connections<'b>,
    /// Where the next record begins.
    next: u64,
    /// Where the uncompressed chunk ends that the scan went into last.
    chunk_end: u64,
    /// Where the index begins, 0 if there is none.
    index: u64,
    header: Vec<u8>,
    data: Vec<u8>,
    chunk: Vec<u8>,
}

impl<'b> Scan<'b> {
    /// Of a file, whose first record begins at byte `first`.
    pub(super) fn new(bytes: &'b Bytes, first: u64) -> Result<Self, RecordingError> {
        let mut source = Source::new(bytes);
        source.seek(first)?;
        let (path, connections) = (bytes.path(), Connections::new(bytes));
        let (header, data, chunk) = (Vec::new(), Vec::new(), Vec::new());
        let (next, chunk_end, index) = (first, 0, 0);
        Ok(Self { path, source, connections, next, chunk_end, index, header, data, chunk })
    }

    pub(super) fn run(mut self, taker: &mut Taker<'_>) -> Result<(), RecordingError> {
        if self.next >= self.source.end() {
            let fault = Fault::cut("the file ends where its first record should begin");
            return taker.decide(fault, self.path, format!("byte {}", self.next));
        }
        while self.next < self.source.end() {
            let start = self.next;
            self.source.seek(start)?;
            if let Err(fault) = self.record(start, taker) {
                taker.decide(fault, self.path, format!("record at byte {start}"))?;
                if self.next >= self.source.end() {
                    return Ok(());
                }
            }
        }
        self.check_end(taker)
    }

    /// A file that was cut between two records shows it by what it promised.
    fn check_end(&self, taker: &mut Taker<'_>) -> Result<(), RecordingError> {
        let end = self.source.end();
        let (promised, what) = if self.chunk_end > end {
            (self.chunk_end, "last chunk does")
        } else {
            (self.index, "index begins")
        };
        if promised <= end {
            return Ok(());
        }
        let problem = format!("the file ends {} bytes before its {what}", promised - end);
        taker.decide(Fault::cut(problem), self.path, format!("byte {end}"))
    }

    /// The record at byte `start`; on an error, the scan may go on at `next`.
    fn record(&mut self, start: u64, taker: &mut Taker<'_>) -> Result<(), Fault> {
        let in_chunk = start < self.chunk_end;
        let limit = if in_chunk { self.chunk_end } else { self.source.end() };
        // Until the record's length is known, only the end of its chunk is a place to go on.
        self.next = limit;
        let record = self.source.record(limit, &mut self.header)?;
        self.next = record.end().min(limit);
        let header = Header::parse(&self.header)?;
        let op = header.op()?;
        if op == Op::Chunk && !in_chunk {
            let chunk = Chunk::parse(header)?;
            return self.chunk(start, chunk, record, taker);
        }
        if record.end() > limit.min(self.source.end()) {
            return Err(self.source.cut(record, limit));
        }
        let largest = match op {
            Op::Message => LARGEST_CHUNK,
            Op::Connection => LARGEST_CONNECTION,
            Op::Chunk => return Err("it is a chunk in a chunk".into()),
            Op::BagHeader => return self.bag_header(),
            Op::Other => return Ok(()),
        };
        if u64::from(record.length) > largest {
            return Err(format!("{} bytes are too many for its kind", record.length).into());
        }
        self.source.fill(&mut self.data, u64::from(record.length))?;
        let place = Location::Bytes { start: record.data, length: record.length };
        take(op, header, &self.data, place, &mut self.connections, taker)
    }

    fn bag_header(&mut self) -> Result<(), Fault> {
        let header = Header::parse(&self.header)?;
        if let Ok(encryptor) = header.text("encryptor")
            && !encryptor.is_empty()
        {
            return Err(Fault::Fatal(RecordingError::invalid(
                self.path,
                "the bag",
                format!("it is encrypted by {encryptor}"),
                "Decrypt it first",
            )));
        }
        self.index = header.u64("index_pos")?;
        self.connections.indexed_at(self.index);
        Ok(())
    }

    fn chunk(
        &mut self,
        start: u64,
        chunk: Chunk,
        record: Record,
        taker: &mut Taker<'_>,
    ) -> Result<(), Fault> {
        let end = self.source.end();
        if chunk.compression == Compression::None {
            if chunk.size != record.length {
                let (size, length) = (chunk.size, record.length);
                return Err(format!("a chunk of {length} bytes says that it has {size}").into());
            }
            // Even of a chunk that is cut, the messages before the cut can be used.
            (self.next, self.chunk_end) = (record.data, record.end());
            return Ok(());
        }
        if record.length == 0 {
            // The recorder writes the length last: the compressed bytes of unknown length follow.
            self.next = end;
            return Err(Fault::cut("the recorder stopped before this chunk was whole"));
        }
        if record.end() > end {
            return Err(self.source.cut(record, end));
        }
        chunk.decompress(&mut self.source, record, &mut self.chunk)?;
        contents(self.path, start, &self.chunk, &mut self.connections, taker)?;
        Ok(())
    }
}
