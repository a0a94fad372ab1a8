//! MCAP files record by record, right or wrong.

use mcap::records::op;

/// A file with these records, with its end if `finished`.
pub(super) fn mcap(records: &[Vec<u8>], finished: bool) -> Vec<u8> {
    let mut bytes = crate::bag::mcap::MAGIC.to_vec();
    bytes.extend(record(op::HEADER, &[text("ros2"), text("")].concat()));
    bytes.extend(records.concat());
    if finished {
        bytes.extend(record(op::DATA_END, &[0; 4]));
        bytes.extend(record(op::FOOTER, &[0; 20]));
        bytes.extend(crate::bag::mcap::MAGIC);
    }
    bytes
}

pub(super) fn record(opcode: u8, body: &[u8]) -> Vec<u8> {
    let mut bytes = vec![opcode];
    bytes.extend((body.len() as u64).to_le_bytes());
    bytes.extend(body);
    bytes
}

pub(super) fn text(text: &str) -> Vec<u8> {
    let mut bytes = (text.len() as u32).to_le_bytes().to_vec();
    bytes.extend(text.as_bytes());
    bytes
}

pub(super) fn schema(id: u16, name: &str) -> Vec<u8> {
    let rest = [text(name), text("ros2msg"), 0_u32.to_le_bytes().to_vec()].concat();
    record(op::SCHEMA, &[id.to_le_bytes().to_vec(), rest].concat())
}

pub(super) fn channel(id: u16, schema: u16, topic: &str) -> Vec<u8> {
    let ids = [id.to_le_bytes(), schema.to_le_bytes()].concat();
    let rest = [text(topic), text("cdr"), 0_u32.to_le_bytes().to_vec()].concat();
    record(op::CHANNEL, &[ids, rest].concat())
}

pub(super) fn message(channel: u16, time_ns: u64, data: &[u8]) -> Vec<u8> {
    let mut body = channel.to_le_bytes().to_vec();
    body.extend(0_u32.to_le_bytes());
    body.extend(time_ns.to_le_bytes());
    body.extend(time_ns.to_le_bytes());
    body.extend(data);
    record(op::MESSAGE, &body)
}

/// A chunk that claims `size` bytes when decompressed, without a check sum.
pub(super) fn chunk(compression: &str, size: u64, stored: &[u8]) -> Vec<u8> {
    let mut body = vec![0; 16];
    body.extend(size.to_le_bytes());
    body.extend(0_u32.to_le_bytes());
    body.extend(text(compression));
    body.extend((stored.len() as u64).to_le_bytes());
    body.extend(stored);
    record(op::CHUNK, &body)
}

/// A schema, a channel and a message in it.
pub(super) fn small() -> [Vec<u8>; 3] {
    [schema(1, "std_msgs/msg/String"), channel(1, 1, "/notes"), message(1, 5, b"hello")]
}
