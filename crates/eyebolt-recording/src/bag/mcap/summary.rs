//! The summary at the end of a file, which helps out where its beginning is damaged.

use super::fields::Fields;
use super::records::Topics;
use super::{FRAMING, MAGIC, McapFile, RecordHead};
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};

/// Bytes of the last record: where the summary and its offsets start, and a checksum.
const FOOTER_BYTES: u64 = 20;

impl McapFile {
    /// Schemas and channels of the summary, if the file has one.
    ///
    /// Many writers tell them once, before the first message, and again in the summary.
    pub(super) fn summarised(&self) -> Topics {
        use mcap::records::op::{CHANNEL, SCHEMA};
        let mut topics = Topics::default();
        let Some(start) = self.summary_start() else { return topics };
        let Ok(file) = File::open(&self.path) else { return topics };
        let mut reader = BufReader::new(file);
        if reader.seek(SeekFrom::Start(start)).is_ok() {
            let mut visit = |head: RecordHead, body: &[u8]| {
                topics.summary(head.opcode, body);
                Ok(())
            };
            // Only a help: the file is read without.
            drop(self.records_from(&mut reader, start, &[SCHEMA, CHANNEL], &mut visit, &mut Err));
        }
        topics
    }

    /// Where the summary starts, which the footer tells.
    fn summary_start(&self) -> Option<u64> {
        let at = self.length.checked_sub(FRAMING + FOOTER_BYTES + MAGIC.len() as u64)?;
        let mut file = File::open(&self.path).ok()?;
        file.seek(SeekFrom::Start(at)).ok()?;
        let mut footer = Vec::new();
        file.take(FRAMING + FOOTER_BYTES).read_to_end(&mut footer).ok()?;
        let mut fields = Fields::new(&footer);
        let opcode = fields.bytes(1).ok()?;
        let length = fields.u64().ok()?;
        let start = fields.u64().ok()?;
        let is_footer = opcode == [mcap::records::op::FOOTER] && length == FOOTER_BYTES;
        Some(start).filter(|start| is_footer && (1..at).contains(start))
    }
}
