//! The summary at the end of a file, which helps out where its beginning is damaged.

use super::fields::Fields;
use super::framing::{FRAMING, MAGIC, RecordHead, Records};
use super::records::Topics;
use crate::bag::bytes::Bytes;
use std::io::Read;

/// Bytes of the last record: where the summary and its offsets start, and a checksum.
const FOOTER_BYTES: u64 = 20;

/// Schemas and channels of the summary, if the file has one.
///
/// Many writers tell them once, before the first message, and again in the summary.
pub(super) fn summarised(bytes: &Bytes) -> Topics {
    use mcap::records::op::{CHANNEL, SCHEMA};
    let mut topics = Topics::default();
    let Some(start) = summary_start(bytes) else { return topics };
    let mut visit = |head: RecordHead, body: &[u8]| {
        topics.summary(head.opcode, body);
        Ok(())
    };
    // Only a help: the file is read without.
    let mut records = Records::from(bytes, start);
    drop(records.visit(&[SCHEMA, CHANNEL], &mut visit, &mut Err));
    topics
}

/// Where the summary starts, which the footer tells.
fn summary_start(bytes: &Bytes) -> Option<u64> {
    let at = bytes.length().checked_sub(FRAMING + FOOTER_BYTES + MAGIC.len() as u64)?;
    let mut footer = Vec::new();
    bytes.reader(at).take(FRAMING + FOOTER_BYTES).read_to_end(&mut footer).ok()?;
    let mut fields = Fields::new(&footer);
    let opcode = fields.bytes(1).ok()?;
    let length = fields.u64().ok()?;
    let start = fields.u64().ok()?;
    let is_footer = opcode == [mcap::records::op::FOOTER] && length == FOOTER_BYTES;
    Some(start).filter(|start| is_footer && (1..at).contains(start))
}
