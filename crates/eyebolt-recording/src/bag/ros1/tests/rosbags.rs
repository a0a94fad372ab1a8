//! Bags of another implementation, and what it reads from them.

use super::support::{Told, bag, file, open, scan, scan_whole};
use crate::bag::{BagFile, Location};
use proptest::prelude::*;
use std::collections::HashSet;
use std::path::{Path, PathBuf};

const BAGS: [&str; 4] = ["ros1_none.bag", "ros1_bz2.bag", "ros1_lz4.bag", "ros1_roslz4.bag"];

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(name)
}

fn bytes(name: &str) -> Vec<u8> {
    std::fs::read(fixture(name)).unwrap()
}

/// Topic, type, time and bytes of every message as `rosbags` reads them, in order of time.
fn oracle(name: &str) -> Vec<(String, String, i64, String)> {
    let lists: serde_json::Value = serde_json::from_slice(&bytes("ros1_bags.json")).unwrap();
    let text = |message: &serde_json::Value, key: &str| message[key].as_str().unwrap().to_owned();
    let messages = lists[name].as_array().unwrap().iter();
    messages
        .map(|m| {
            let time_ns = m["log_time_ns"].as_i64().unwrap();
            (text(m, "topic"), text(m, "type"), time_ns, text(m, "hex"))
        })
        .collect()
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[test]
fn every_message_is_what_rosbags_reads() {
    for name in BAGS {
        let mut messages = scan_whole(&open(&fixture(name)).unwrap());
        assert!(!messages.is_sorted_by_key(|m| m.log_time_ns), "{name} is in order of the file");
        messages.sort_by_key(|m| m.log_time_ns);
        let told = messages.into_iter();
        let told: Vec<_> =
            told.map(|m| (m.topic, m.message_type, m.log_time_ns, hex(&m.data))).collect();
        assert_eq!(told, oracle(name), "{name}");
    }
}

#[test]
fn publishers_of_a_topic_are_one_topic() {
    for name in BAGS {
        let messages = scan_whole(&open(&fixture(name)).unwrap());
        let topics: HashSet<_> =
            messages.iter().map(|m| (m.topic_index, m.topic.as_str())).collect();
        assert_eq!(topics, HashSet::from([(0, "/joint_states"), (1, "/notes")]), "{name}");
    }
}

#[test]
fn any_message_is_found_again_by_several_threads_in_any_order() {
    for name in BAGS {
        let bag = open(&fixture(name)).unwrap();
        let messages = scan_whole(&bag);
        assert!(name == "ros1_none.bag" || chunks(&messages).len() > 2, "{name} has many chunks");
        std::thread::scope(|scope| {
            // Strides without a common divisor with the count take everything once.
            for stride in [1, 3, 7, 19] {
                let (bag, messages) = (&bag, &messages);
                assert!(!messages.len().is_multiple_of(stride) || stride == 1);
                scope.spawn(move || {
                    for i in 0..messages.len() {
                        let message = &messages[i * stride % messages.len()];
                        assert_eq!(bag.read(message.place).unwrap(), message.data, "{name}");
                    }
                });
            }
        });
    }
}

#[test]
fn every_prefix_is_an_error_or_whole() {
    for name in BAGS {
        let bytes = bytes(name);
        let (file, whole) = bag(&bytes);
        let messages = scan_whole(&whole);
        let index = usize::try_from(u64::from_le_bytes(index_pos(&bytes))).unwrap();
        for length in (0..bytes.len()).rev() {
            file.as_file().set_len(length as u64).unwrap();
            let Ok(prefix) = open(file.path()) else {
                assert!(length < 13, "{name} of {length} bytes");
                continue;
            };
            let (told, problems) = scan(&prefix);
            assert_eq!(told, messages[..told.len()], "{name} of {length} bytes");
            if length < index {
                assert_eq!(problems.len(), 1, "{name} of {length} bytes");
            } else {
                assert_eq!(told.len(), messages.len(), "{name} of {length} bytes");
            }
        }
    }
}

/// Of the bag header, by the bytes of its name.
fn index_pos(bytes: &[u8]) -> [u8; 8] {
    let name = b"index_pos=";
    let at = bytes.windows(name.len()).position(|window| window == name).unwrap() + name.len();
    bytes[at..at + 8].try_into().unwrap()
}

/// Where the chunks begin that have messages.
fn chunks(messages: &[Told]) -> Vec<usize> {
    let mut starts = Vec::new();
    for message in messages {
        if let Location::InChunk { chunk, .. } = message.place {
            starts.push(usize::try_from(chunk).unwrap());
        }
    }
    starts.dedup();
    starts
}

#[test]
fn a_corrupt_chunk_costs_its_own_messages_only() {
    let (bz2, lz4) = (b"BZh9", &[4, 0x22, 0x4d, 0x18]);
    for (name, magic) in [("ros1_bz2.bag", bz2), ("ros1_lz4.bag", lz4), ("ros1_roslz4.bag", lz4)] {
        let good = bytes(name);
        let messages = scan_whole(&bag(&good).1);
        // The first one too, although only it and the index tell the connections.
        for corrupt in chunks(&messages) {
            let mut bytes = good.clone();
            let magic_at = bytes[corrupt..].windows(4).position(|window| window == magic).unwrap();
            bytes[corrupt + magic_at] ^= 0x40;
            let (told, problems) = scan(&bag(&bytes).1);
            let there = |m: &&Told| chunks(std::slice::from_ref(*m)) == [corrupt];
            let rest: Vec<_> = messages.iter().filter(|m| !there(m)).map(what).collect();
            assert_eq!(told.iter().map(what).collect::<Vec<_>>(), rest);
            let [problem] = problems.as_slice() else { panic!("{problems:?}") };
            let field = format!("record at byte {corrupt}: it cannot be decompressed: ");
            assert!(problem.contains(&field), "{problem}");
            assert!(problem.ends_with("or give argument `partial` to use the rest"), "{problem}");
        }
    }
}

/// All but the number of the topic, which depends on what came before.
fn what(message: &Told) -> (&str, i64, Location, &[u8]) {
    (&message.topic, message.log_time_ns, message.place, &message.data)
}

proptest! {
    #[test]
    fn no_byte_makes_it_panic(
        name in prop::sample::select(&BAGS[..]),
        at in any::<prop::sample::Index>(),
        value in any::<u8>(),
    ) {
        let mut bytes = bytes(name);
        // Most of the 4 KiB of padding behind the bag header is of no interest.
        let at = at.index(bytes.len() - 3900);
        let at = if at < 150 { at } else { at + 3900 };
        bytes[at] = value;
        let file = file(&bytes);
        if let Ok(bag) = open(file.path()) {
            let (messages, _) = scan(&bag);
            for message in messages {
                prop_assert_eq!(bag.read(message.place).unwrap(), message.data);
            }
        }
    }
}
