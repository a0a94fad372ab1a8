//! Bytes of bags, true or not.

use bzip2::write::BzEncoder;
use lz4_flex::frame::FrameEncoder;
use std::io::Write;

pub(super) const MAGIC: &[u8] = b"#ROSBAG V2.0\n";

pub(super) type Fields<'a> = &'a [(&'a str, &'a [u8])];

/// Bytes behind their length.
pub(super) fn sized(bytes: &[u8]) -> Vec<u8> {
    let length = u32::try_from(bytes.len()).unwrap();
    [&length.to_le_bytes(), bytes].concat()
}

pub(super) fn fields(fields: Fields<'_>) -> Vec<u8> {
    let field = |(name, value): &(&str, &[u8])| sized(&[name.as_bytes(), b"=", value].concat());
    fields.iter().flat_map(field).collect()
}

pub(super) fn record(header: Fields<'_>, data: &[u8]) -> Vec<u8> {
    [sized(&fields(header)), sized(data)].concat()
}

/// The first record, padded less than by ROS.
pub(super) fn bag_header(index_pos: u64) -> Vec<u8> {
    record(
        &[
            ("op", &[3]),
            ("index_pos", &index_pos.to_le_bytes()),
            ("conn_count", &[0; 4]),
            ("chunk_count", &[0; 4]),
        ],
        &[b' '; 16],
    )
}

pub(super) fn connection(id: u32, topic: &str, kind: &str) -> Vec<u8> {
    let header: Fields<'_> =
        &[("op", &[7]), ("conn", &id.to_le_bytes()), ("topic", topic.as_bytes())];
    // The name before it was remapped, which is not the one to use.
    let data = fields(&[
        ("topic", b"/unmapped"),
        ("type", kind.as_bytes()),
        ("md5sum", b"*"),
        ("message_definition", b"uint8 = # not a field of the record = at all"),
    ]);
    record(header, &data)
}

pub(super) fn message(id: u32, time: [u32; 2], data: &[u8]) -> Vec<u8> {
    let time = [time[0].to_le_bytes(), time[1].to_le_bytes()].concat();
    record(&[("op", &[2]), ("conn", &id.to_le_bytes()), ("time", &time)], data)
}

/// A chunk that declares `size`, whatever is in it.
pub(super) fn chunk(compression: &str, size: usize, stored: &[u8]) -> Vec<u8> {
    let size = u32::try_from(size).unwrap().to_le_bytes();
    record(&[("op", &[5]), ("compression", compression.as_bytes()), ("size", &size)], stored)
}

pub(super) fn compressed(compression: &str, contents: &[u8]) -> Vec<u8> {
    match compression {
        "bz2" => {
            let mut encoder = BzEncoder::new(Vec::new(), bzip2::Compression::best());
            encoder.write_all(contents).unwrap();
            encoder.finish().unwrap()
        }
        "lz4" => {
            let mut encoder = FrameEncoder::new(Vec::new());
            encoder.write_all(contents).unwrap();
            encoder.finish().unwrap()
        }
        _ => contents.to_vec(),
    }
}

/// A chunk that is as it says.
pub(super) fn true_chunk(compression: &str, contents: &[u8]) -> Vec<u8> {
    chunk(compression, contents.len(), &compressed(compression, contents))
}

/// A file without an index of these records.
pub(super) fn unindexed(records: &[Vec<u8>]) -> Vec<u8> {
    [MAGIC.to_vec(), bag_header(0), records.concat()].concat()
}
