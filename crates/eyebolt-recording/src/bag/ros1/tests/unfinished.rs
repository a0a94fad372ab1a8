//! What is left when a recorder is killed.

use super::support::{bag, scan, scan_whole};
use super::writer::{MAGIC, bag_header, chunk, compressed, connection, message};
use super::writer::{true_chunk, unindexed};

const CUT: &str = "Was the recorder killed? Repair it with `rosbag reindex`, or give argument `partial` to use what is before";

fn camera() -> Vec<u8> {
    connection(0, "/camera", "sensor_msgs/Image")
}

/// Data of the messages and the only problem of a file.
fn partial(bytes: &[u8]) -> (Vec<Vec<u8>>, String) {
    let (messages, problems) = scan(&bag(bytes).1);
    let [problem] = problems.as_slice() else { panic!("{problems:?}") };
    let (_, problem) = problem.split_once(": ").unwrap();
    (messages.into_iter().map(|m| m.data).collect(), problem.to_owned())
}

#[test]
fn a_cut_record_tells_where_and_by_how_much() {
    let bytes = unindexed(&[camera(), message(0, [1, 0], b"a"), message(0, [2, 0], &[0; 1000])]);
    let start = unindexed(&[camera(), message(0, [1, 0], b"a")]).len();
    let (data, problem) = partial(&bytes[..bytes.len() - 812]);
    assert_eq!(data, [b"a"]);
    let expected =
        format!("record at byte {start}: the file ends 812 bytes before the record does");
    assert_eq!(problem, format!("{expected}. {CUT}"));
    let (data, problem) = partial(&bytes[..start + 20]);
    assert_eq!(data, [b"a"]);
    assert_eq!(problem, format!("record at byte {start}: the file ends in its header. {CUT}"));
}

#[test]
fn an_uncompressed_chunk_that_was_not_closed_is_read() {
    // Its length is written when it is full; until then it is 0.
    let records = [camera(), chunk("none", 0, b""), message(0, [1, 0], b"a")];
    assert_eq!(scan_whole(&bag(&unindexed(&records)).1).len(), 1);
}

#[test]
fn a_compressed_chunk_that_was_not_closed_is_cut() {
    let closed = true_chunk("lz4", &message(0, [1, 0], b"a"));
    for compression in ["lz4", "bz2"] {
        let stored = compressed(compression, &message(0, [2, 0], &[0; 999]));
        let open = chunk(compression, 0, b"");
        let start = unindexed(&[camera(), closed.clone()]).len();
        let (data, problem) = partial(&unindexed(&[camera(), closed.clone(), open, stored]));
        assert_eq!(data, [b"a"]);
        let expected = "the recorder stopped before this chunk was whole";
        assert_eq!(problem, format!("record at byte {start}: {expected}. {CUT}"));
    }
}

#[test]
fn messages_before_the_cut_of_an_uncompressed_chunk_are_read() {
    let [first, second] = [message(0, [1, 0], b"a"), message(0, [2, 0], b"b")];
    let bytes = unindexed(&[camera(), true_chunk("none", &[first, second.clone()].concat())]);
    for missing in 1..second.len() {
        let (data, problem) = partial(&bytes[..bytes.len() - missing]);
        assert_eq!(data, [b"a"]);
        assert!(problem.contains("the file ends "), "{problem}");
    }
    let (data, problem) = partial(&bytes[..bytes.len() - second.len()]);
    assert_eq!(data, [b"a"]);
    let (at, missing) = (bytes.len() - second.len(), second.len());
    let expected = format!("byte {at}: the file ends {missing} bytes before its last chunk does");
    assert_eq!(problem, format!("{expected}. {CUT}"));
}

#[test]
fn a_file_cut_between_records_is_known_by_its_index() {
    let records = [camera(), message(0, [1, 0], b"a")].concat();
    let end = MAGIC.len() + bag_header(0).len() + records.len();
    let header = bag_header(end as u64 + 5);
    let (data, problem) = partial(&[MAGIC, &header, &records].concat());
    assert_eq!(data, [b"a"]);
    let expected = format!("byte {end}: the file ends 5 bytes before its index begins");
    assert_eq!(problem, format!("{expected}. {CUT}"));
}

#[test]
fn zeros_that_a_power_cut_leaves_are_one_problem() {
    let good = unindexed(&[camera(), message(0, [1, 0], b"a")]);
    let (data, problem) = partial(&[good.clone(), vec![0; 5000]].concat());
    assert_eq!(data, [b"a"]);
    assert!(problem.starts_with(&format!("record at byte {}: its header is empty", good.len())));
}
