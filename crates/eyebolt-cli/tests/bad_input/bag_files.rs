//! Bags that are cut short, damaged, or lie about their size.

use crate::bag::{Mcap, channels, chunk, message, seconds};
use crate::desk::Desk;
use crate::outcome::assert_unusable;
use crate::run::fixture;
use rusqlite::{Connection, params};
use std::fs;

/// Checks that nothing can be made of a bag of these bytes.
#[track_caller]
fn assert_unusable_bag(name: &str, bytes: &[u8], words: &[&str]) {
    let desk = Desk::new();
    let path = desk.file(name);
    fs::write(&path, bytes).unwrap();
    assert_unusable(&path, &[&[name], words].concat());
}

#[test]
fn a_bag_that_is_cut_short() {
    let whole = Mcap::new().with(&channels()).with(&seconds(1)).finish();
    let words = ["record at byte", "the file ends in the middle", "mcap recover", "--partial"];
    assert_unusable_bag("bag.mcap", &whole[..whole.len() * 2 / 3], &words);
}

#[test]
fn a_damaged_chunk() {
    let records = [channels(), seconds(1)].concat();
    let mut packed = zstd::bulk::compress(&records, 1).unwrap();
    let middle = packed.len() / 2;
    packed[middle..middle + 16].fill(0xff);
    for (compression, data) in [("zstd", &packed), ("lz4", &packed)] {
        let damaged = chunk(compression, records.len() as u64, data);
        let words = ["record at byte", "chunk", "--partial"];
        assert_unusable_bag("bag.mcap", &Mcap::new().with(&damaged).finish(), &words);
    }
}

#[test]
fn a_chunk_that_claims_to_unpack_to_ten_gigabytes() {
    let packed = zstd::bulk::compress(&[channels(), seconds(1)].concat(), 1).unwrap();
    for compression in ["", "zstd", "lz4"] {
        let bytes = Mcap::new().with(&chunk(compression, 10 << 30, &packed)).finish();
        let words = ["record at byte", "10737418240 bytes", "--partial"];
        assert_unusable_bag("bag.mcap", &bytes, &words);
    }
}

#[test]
fn a_record_that_claims_ten_gigabytes() {
    let mut bytes = Mcap::new().with(&channels()).0;
    for opcode in [5, 6] {
        bytes.push(opcode);
        bytes.extend((10_u64 << 30).to_le_bytes());
        let words = ["record at byte", "the file ends in the middle", "--partial"];
        assert_unusable_bag("bag.mcap", &bytes, &words);
    }
}

#[test]
fn a_message_of_a_channel_that_is_not_there() {
    let bytes = Mcap::new().with(&channels()).with(&message(77, 0, b"data")).finish();
    assert_unusable_bag("bag.mcap", &bytes, &["record at byte", "channel 77", "--partial"]);
}

/// Compressed chunks of ROS 1 with 16 bytes in the middle of the first overwritten.
#[test]
fn a_damaged_chunk_of_ros_1() {
    for name in ["ros1_lz4.bag", "ros1_roslz4.bag", "ros1_bz2.bag"] {
        let mut bytes = fs::read(fixture("eyebolt-recording", name)).unwrap();
        let marker = b"compression=";
        let header = bytes.windows(marker.len()).position(|window| window == marker).unwrap();
        bytes[header + 200..header + 216].fill(0xff);
        assert_unusable_bag(name, &bytes, &["record at byte", "copy it again", "--partial"]);
    }
}

/// A page in the middle, every bit of it turned over.
#[test]
fn a_database_with_a_turned_page() {
    let desk = Desk::new();
    let path = desk.file("bag.db3");
    let connection = Connection::open(&path).unwrap();
    let tables =
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,
            serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);
        CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,
            timestamp INTEGER NOT NULL, data BLOB NOT NULL);
        INSERT INTO topics VALUES(1, '/notes', 'std_msgs/msg/String', 'cdr', '');";
    connection.execute_batch(tables).unwrap();
    let insert = "INSERT INTO messages(topic_id, timestamp, data) VALUES(1, ?1, ?2)";
    for time in 0..400 {
        connection.execute(insert, params![time, vec![7_u8; 300]]).unwrap();
    }
    connection.close().unwrap();
    let mut bytes = fs::read(&path).unwrap();
    let (pages, _) = bytes.as_chunks_mut::<4096>();
    let middle = pages.len() / 2;
    pages[middle].iter_mut().for_each(|byte| *byte = !*byte);
    assert_unusable_bag("bag.db3", &bytes, &["database", "malformed", "copy it again"]);
}
