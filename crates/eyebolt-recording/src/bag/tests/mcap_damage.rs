//! MCAP files of others, cut short or with wrong bytes.

use super::support::{Told, assert_says, file, fixture, open, scan, scan_whole, strict};
use crate::bag::Location;
use proptest::prelude::*;

const FILES: [&str; 6] =
    ["none.mcap", "lz4.mcap", "zstd.mcap", "unchunked.mcap", "no_summary.mcap", "no_crc.mcap"];

fn bytes(name: &str) -> Vec<u8> {
    std::fs::read(fixture(name)).unwrap()
}

/// The offset of the first record with this opcode, by walking over the records.
fn first(bytes: &[u8], opcode: u8) -> usize {
    let mut at = 8;
    while bytes[at] != opcode {
        at += 9 + u64::from_le_bytes(bytes[at + 1..at + 9].try_into().unwrap()) as usize;
    }
    at
}

/// Behind the last byte of the message's record, or of its chunk's.
fn end(bytes: &[u8], told: &Told) -> usize {
    let record = match told.locator.place() {
        Location::Bytes { start, .. } => start as usize - 31,
        Location::InChunk { chunk, .. } => chunk as usize,
        Location::Row(_) => unreachable!(),
    };
    record + 9 + u64::from_le_bytes(bytes[record + 1..record + 9].try_into().unwrap()) as usize
}

#[test]
fn every_prefix_gives_what_is_before_the_cut() {
    for name in FILES {
        let bytes = bytes(name);
        let whole = scan_whole(&open(&fixture(name)).unwrap());
        let data_end = first(&bytes, mcap::records::op::DATA_END);
        let (_folder, path) = file("cut.mcap", &bytes);
        let handle = std::fs::File::options().write(true).open(&path).unwrap();
        for length in (0..bytes.len()).rev() {
            handle.set_len(length as u64).unwrap();
            let Ok(bag) = open(&path) else {
                assert!(length < 8, "{name} of {length} bytes");
                continue;
            };
            let (told, problems) = scan(&bag);
            let before = whole.iter().filter(|told| end(&bytes, told) <= length).count();
            assert_eq!(told, whole[..before], "{name} of {length} bytes");
            if length < data_end + 9 {
                assert_eq!(problems.len(), 1, "{name} of {length} bytes");
                assert_says(strict(&bag), &["record at byte", "`mcap recover`", "`partial`"]);
            } else {
                assert_eq!((problems.len(), told.len()), (0, whole.len()));
            }
        }
    }
}

#[test]
fn the_byte_of_the_cut_record_is_named() {
    let whole = bytes("no_summary.mcap");
    let chunk = first(&whole, mcap::records::op::CHUNK);
    let (_folder, path) = file("cut.mcap", &whole[..chunk + 20]);
    let named = format!("{}: record at byte {chunk}: the file ends", path.display());
    assert_says(strict(&open(&path).unwrap()), &[&named]);
}

#[test]
fn a_corrupt_chunk_costs_its_own_messages_only() {
    for (name, problem) in [
        ("zstd.mcap", "cannot be decompressed"),
        ("lz4.mcap", "cannot be decompressed"),
        ("none.mcap", "checksum is wrong"),
    ] {
        let good = bytes(name);
        let whole = scan_whole(&open(&fixture(name)).unwrap());
        let place = |told: &Told| end(&good, told);
        // The first one too, although the channels stand only there and in the summary.
        let mut ends: Vec<_> = whole.iter().map(place).collect();
        ends.dedup();
        assert!(ends.len() > 2, "{name} has several chunks");
        for corrupt in ends {
            let mut bytes = good.clone();
            // In the middle of a chunk, where the last bytes of one message are.
            bytes[corrupt - 12] ^= 0x10;
            bytes[corrupt - 11] ^= 0xff;
            let (_folder, path) = file("corrupt.mcap", &bytes);
            let bag = open(&path).unwrap();
            let (told, problems) = scan(&bag);
            let rest: Vec<_> = whole.iter().filter(|t| place(t) != corrupt).cloned().collect();
            assert_eq!(told, rest, "{name}");
            assert_eq!(problems.len(), 1, "{name}: {problems:?}");
            assert!(problems[0].contains("chunk"), "{name}: {problems:?}");
            let told: &[&str] = if name == "none.mcap" { &[problem] } else { &["record at byte"] };
            assert_says(strict(&bag), told);
        }
    }
}

#[test]
fn without_check_sums_nothing_is_checked() {
    let mut bytes = bytes("no_crc.mcap");
    let hello = bytes.windows(5).position(|window| window == b"hello").unwrap();
    bytes[hello] = b'j';
    let (_folder, path) = file("changed.mcap", &bytes);
    assert!(scan_whole(&open(&path).unwrap()).iter().any(|told| told.data.ends_with(b"jello\0")));
}

proptest! {
    #[test]
    fn no_byte_makes_it_panic(
        name in prop::sample::select(&FILES[..]),
        at in any::<prop::sample::Index>(),
        value in any::<u8>(),
    ) {
        let mut bytes = bytes(name);
        *at.get_mut(&mut bytes) = value;
        let (_folder, path) = file("changed.mcap", &bytes);
        if let Ok(bag) = open(&path) {
            for told in scan(&bag).0 {
                prop_assert_eq!(bag.read(told.locator).unwrap(), told.data);
            }
        }
    }
}
