//! Bags that lie.

mod between;
mod chunks;
mod headers;

use super::support::{bag, file, open, said, scan};
use super::writer::{MAGIC, bag_header, message, record, true_chunk, unindexed};
use crate::bag::{BagFile, Location};
use crate::error::RecordingError;
use between::camera;
use std::path::Path;

#[test]
fn other_files_are_told_apart() {
    for (bytes, problem) in [
        (
            &b"#ROSBAG V1.2\n and more"[..],
            "version 1.2 of bags is not read. Convert it to version 2.0 with `rosbag reindex`",
        ),
        (
            b"#ROSBAG V2.1\n",
            "version 2.1 of bags is not read. Convert it to version 2.0 with `rosbag reindex`",
        ),
        (
            b"\x89MCAP0\r\n and more than that",
            "it is not `#ROSBAG V2.0`. Name a file that ROS 1 recorded",
        ),
        (b"#ROSBAG V2.0", "it is not `#ROSBAG V2.0`. Name a file that ROS 1 recorded"),
        (b"", "it is not `#ROSBAG V2.0`. Name a file that ROS 1 recorded"),
    ] {
        let file = file(bytes);
        let error = said(open(file.path()).unwrap_err());
        assert!(error.ends_with(&format!(": the first line: {problem}")), "{error}");
    }
    let missing = open(Path::new("no/such.bag")).unwrap_err();
    assert!(matches!(missing, RecordingError::Read { .. }), "{missing}");
    open(&std::env::temp_dir()).unwrap_err();
}

#[test]
fn an_error_of_whoever_takes_the_messages_ends_the_scan() {
    let inside = true_chunk("lz4", &message(0, [1, 0], b"a"));
    let records = [camera(), inside, message(0, [2, 0], b"b")];
    let (_file, bag) = bag(&unindexed(&records));
    for enough in 1..=2 {
        let mut count = 0;
        let result = bag.scan(
            &mut |_| {
                count += 1;
                if count < enough {
                    return Ok(());
                }
                Err(RecordingError::NoSuchFrame { path: "x".into(), index: 0, count: 0 })
            },
            &mut |error| panic!("no damage: {error}"),
        );
        assert!(matches!(result, Err(RecordingError::NoSuchFrame { .. })));
        assert_eq!(count, enough);
    }
}

#[test]
fn an_error_about_damage_ends_the_scan() {
    let records = [camera(), message(9, [1, 0], b"a"), message(0, [2, 0], b"b")];
    let (_file, bag) = bag(&unindexed(&records));
    let error = bag.scan(&mut |_| panic!("a message after the damage"), &mut Err).unwrap_err();
    assert!(said(error).contains("connection 9, which is not told"));
}

#[test]
fn encrypted_bags_are_refused() {
    let header = record(
        &[("op", &[3]), ("index_pos", &[0; 8]), ("encryptor", b"rosbag/AesCbcEncryptor")],
        b"",
    );
    let (_file, bag) = bag(&[MAGIC, &header].concat());
    let error = said(bag.scan(&mut |_| Ok(()), &mut |_| Ok(())).unwrap_err());
    let expected = "the bag: it is encrypted by rosbag/AesCbcEncryptor. Decrypt it first";
    assert!(error.ends_with(expected), "{error}");
}

#[test]
fn an_index_that_is_none_helps_nobody() {
    let records = [camera(), message(9, [1, 0], b"a"), message(0, [2, 0], b"b")].concat();
    for index in [1, 13, 60, MAGIC.len() + bag_header(0).len() + 7] {
        let bytes = [MAGIC.to_vec(), bag_header(index as u64), records.clone()].concat();
        let (messages, problems) = scan(&bag(&bytes).1);
        assert_eq!((messages.len(), problems.len()), (1, 1), "{problems:?}");
    }
}

#[test]
fn places_that_no_scan_told_are_errors() {
    let records = [camera(), true_chunk("lz4", &message(0, [1, 0], b"a"))];
    let bytes = unindexed(&records);
    let chunk = unindexed(&[camera()]).len() as u64;
    let (_file, bag) = bag(&bytes);
    for place in [
        Location::Bytes { start: bytes.len() as u64, length: 1 },
        Location::Bytes { start: 0, length: u32::MAX },
        Location::Bytes { start: u64::MAX, length: u32::MAX },
        Location::InChunk { chunk: 0, start: 0, length: 1 },
        Location::InChunk { chunk: 13, start: 0, length: 1 },
        Location::InChunk { chunk: u64::MAX, start: 0, length: 1 },
        Location::InChunk { chunk, start: 0, length: 5000 },
        Location::InChunk { chunk, start: u32::MAX, length: u32::MAX },
        Location::Row(1),
    ] {
        let error = said(bag.read(place).unwrap_err());
        assert!(error.contains(": message "), "{error}");
    }
}
