//! Headers that are not whole, or say what cannot be.

use super::super::writer::{connection, fields, message, record, sized};
use super::between::{problem_of, problems_of};

#[test]
fn headers_that_are_not_whole() {
    let conn = ("conn", &[0_u8; 4][..]);
    let time = ("time", &[0_u8; 8][..]);
    for (bad, problem) in [
        (record(&[conn, time], b"x"), "it has no field `op`"),
        (record(&[("op", &[2]), conn], b"x"), "it has no field `time`"),
        (record(&[("op", &[2]), time], b"x"), "it has no field `conn`"),
        (
            record(&[("op", &[2, 0]), conn, time], b"x"),
            "its field `op` has 2 bytes where 1 are needed",
        ),
        (
            record(&[("op", &[2]), ("conn", &[0]), time], b"x"),
            "its field `conn` has 1 bytes where 4 are needed",
        ),
        (record(&[("op", &[7]), conn], b"x"), "it has no field `topic`"),
        (record(&[("op", &[7]), conn, ("topic", b"\xff")], b"x"), "its field `topic` is not text"),
        (record(&[("op", &[7]), conn, ("topic", b"/a")], b""), "it has no field `type`"),
        (record(&[("op", &[5]), ("size", &[0; 4])], b""), "it has no field `compression`"),
        (record(&[("op", &[5]), ("compression", b"none")], b""), "it has no field `size`"),
        (record(&[("op", &[3])], b""), "it has no field `index_pos`"),
        (empty_record(&sized(b"op")), "a field of its header has no `=`"),
        (empty_record(b"\x09\0\0\0op=\x02"), "a field is longer than the header that it is in"),
        (empty_record(b"op="), "a field is longer than the header that it is in"),
        (message(7, [0, 0], b"x"), "it belongs to connection 7, which is not told"),
        (
            connection(0, "/other", "sensor_msgs/Image"),
            "connection 0 was /camera before and is /other now",
        ),
        (connection(1, &"/long".repeat(300), "a/B"), "a name is too long for a topic or type"),
    ] {
        assert_eq!(problem_of(&bad), problem);
    }
}

/// A record without data whose header is `header`.
fn empty_record(header: &[u8]) -> Vec<u8> {
    [sized(header), sized(b"")].concat()
}

#[test]
fn records_that_are_not_known_are_skipped() {
    assert!(problems_of(&record(&[("op", &[99]), ("new", b"")], b"anything")).is_empty());
    assert!(problems_of(&record(&[("op", &[4])], b"")).is_empty());
}

#[test]
fn connection_data_is_a_header_of_its_own() {
    let header: &[(&str, &[u8])] = &[("op", &[7]), ("conn", &[1, 0, 0, 0]), ("topic", b"/b")];
    let bad = record(header, &fields(&[("type", b"\xc3")]));
    assert_eq!(problem_of(&bad), "its field `type` is not text");
}
