//! MCAP files that claim what cannot be.

use super::mcap_writer::{channel, chunk, mcap, message, record, schema, small, text};
use super::support::{assert_says, file, open, scan, scan_whole, strict};
use mcap::records::op;

/// What is wrong with a file of these records, and how many messages it has.
fn wrong(records: &[Vec<u8>]) -> (Vec<String>, usize) {
    let (_folder, path) = file("wrong.mcap", &mcap(records, true));
    let bag = open(&path).unwrap();
    let (told, problems) = scan(&bag);
    assert_eq!(strict(&bag).is_err(), !problems.is_empty());
    (problems, told.len())
}

/// Checks that one record is refused in these words and the message behind it is read.
#[track_caller]
fn refused(bad: Vec<u8>, words: &str) {
    let [schema, channel, message] = small();
    let (problems, count) = wrong(&[schema, channel, bad, message]);
    assert_eq!((problems.len(), count), (1, 1), "{problems:?}");
    assert!(problems[0].contains(words), "no {words:?} in {}", problems[0]);
}

#[test]
fn chunks_must_be_what_they_claim() {
    let records = small()[2].clone();
    let size = records.len() as u64;
    refused(chunk("zstd", 10_000_000_000, &records), "claims 10000000000 bytes, more than 256 MiB");
    refused(chunk("", size + 1, &records), "decompresses to");
    refused(chunk("zstd", size, &records), "cannot be decompressed");
    refused(chunk("lz4", size, &records), "cannot be decompressed");
    refused(chunk("bz2", size, &records), "compression \"bz2\" is not known");
    refused(chunk("", 20, &records[..20]), "a record at byte 0 of the chunk is cut short");
    // Claims that no compression could keep are refused before memory is asked for.
    refused(chunk("zstd", 250 << 20, &[0; 8]), "8 bytes of Zstandard are never 262144000");
    refused(chunk("lz4", 250 << 20, &[0; 8]), "8 bytes of LZ4 are never 262144000");
    refused(record(op::CHUNK, &[0; 20]), "ends in the middle of a field");
    let mut longer = chunk("", size, &records);
    let at = longer.len() - records.len() - 8;
    longer[at..at + 8].copy_from_slice(&u64::MAX.to_le_bytes());
    refused(longer, "18446744073709551615 bytes are claimed");
}

#[test]
fn messages_must_have_a_channel() {
    refused(message(9, 5, b"?"), "a message of channel 9, which is not known");
    refused(channel(9, 9, "/lost"), "a channel of schema 9, which is unknown");
    refused(record(op::MESSAGE, &[1, 0]), "ends in the middle of a field");
    refused(record(op::CHANNEL, &[1, 0]), "ends in the middle of a field");
}

#[test]
fn a_number_means_one_thing() {
    let again = [schema(1, "std_msgs/msg/String"), channel(1, 1, "/notes")];
    assert_eq!(wrong(&[small().to_vec(), again.to_vec()].concat()), (vec![], 1));
    refused(schema(1, "std_msgs/msg/Other"), "schema 1 is defined twice");
    refused(channel(1, 1, "/other"), "channel 1 is defined twice");
}

#[test]
fn texts_longer_than_their_record_are_not_allocated() {
    let long = u32::MAX.to_le_bytes();
    refused(record(op::SCHEMA, &[&[2, 0][..], &long].concat()), "4294967295 bytes are claimed");
    refused(record(op::CHANNEL, &[&[2, 0, 1, 0][..], &long].concat()), "4294967295 bytes");
    refused(record(op::CHUNK, &[&[0; 28][..], &long].concat()), "4294967295 bytes are claimed");
    refused(record(op::SCHEMA, &[2, 0, 1, 0, 0, 0, 255]), "not UTF-8");
    // Metadata of ours that cannot be read are as if they were not there.
    let metadata = record(op::METADATA, &[text("eyebolt"), long.to_vec()].concat());
    let (_folder, path) = file("metadata.mcap", &mcap(&[metadata], true));
    assert_eq!(open(&path).unwrap().metadata(), None);
}

#[test]
fn records_of_other_kinds_are_passed_over() {
    let [schema, channel, message] = small();
    let mut chunked = record(0x77, b"?");
    chunked.extend(&message);
    // A chunk in a chunk is none.
    chunked.extend(chunk("", 1, b"x"));
    let chunk = chunk("", chunked.len() as u64, &chunked);
    assert_eq!(wrong(&[schema, record(0x80, &[0; 99]), channel, chunk]), (vec![], 1));
}

#[test]
fn an_oversized_record_is_passed_over() {
    let [schema, channel, message] = small();
    let mut bytes = mcap(&[schema, channel, vec![op::MESSAGE]], false);
    let length = 600_u64 << 20;
    bytes.extend(length.to_le_bytes());
    let (_folder, path) = file("sparse.mcap", &bytes);
    // A hole in the file: it takes no room on the disk.
    let handle = std::fs::File::options().append(true).open(&path).unwrap();
    handle.set_len(bytes.len() as u64 + length).unwrap();
    std::io::Write::write_all(&mut &handle, &[message, record(op::DATA_END, &[0; 4])].concat())
        .unwrap();
    let (told, problems) = scan(&open(&path).unwrap());
    assert_eq!((told.len(), problems.len()), (1, 1), "{problems:?}");
    assert!(problems[0].contains("629145600 bytes, more than 256 MiB"), "{problems:?}");
}

#[test]
fn a_length_beyond_the_file_ends_it() {
    let mut bytes = mcap(&small(), false);
    let at = bytes.len();
    bytes.push(op::MESSAGE);
    bytes.extend(u64::MAX.to_le_bytes());
    bytes.extend([0; 100]);
    let (_folder, path) = file("long.mcap", &bytes);
    let bag = open(&path).unwrap();
    assert_eq!(scan(&bag).0.len(), 1);
    assert_says(strict(&bag), &[&format!("record at byte {at}: the file ends in the middle")]);
}

#[test]
fn publishers_of_a_topic_are_one_topic() {
    let [schema, first, message_of_first] = small();
    let records = [schema, first, channel(2, 1, "/notes"), message_of_first, message(2, 6, b"b")];
    let (_folder, path) = file("two.mcap", &mcap(&records, true));
    let bag = open(&path).unwrap();
    let mut numbers = Vec::new();
    let mut note = |_, message: &crate::bag::Message<'_>| {
        numbers.push(message.topic_index);
        Ok(())
    };
    bag.scan(&mut note, &mut Err).unwrap();
    assert_eq!(numbers, [0, 0]);
    // Times beyond 2262 are as late as can be.
    let late = [small().to_vec(), vec![message(1, u64::MAX, b"late")]].concat();
    let (_folder, path) = file("late.mcap", &mcap(&late, true));
    assert_eq!(scan_whole(&open(&path).unwrap())[1].log_time_ns, i64::MAX);
}
