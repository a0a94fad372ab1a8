//! Bags of other implementations, and what these read from them.

use super::support::{Told, fixture, open, scan_whole};
use serde_json::Value;
use std::collections::BTreeMap;

/// Topic, type, time, length and check sum.
type Line = (String, String, i64, u64, u32);

fn oracle() -> BTreeMap<String, Vec<Line>> {
    let bytes = std::fs::read(fixture("../bags.json")).unwrap();
    let lists: BTreeMap<String, Vec<Value>> = serde_json::from_slice(&bytes).unwrap();
    let text = |value: &Value| value.as_str().unwrap().to_owned();
    let line = |message: &Value| {
        (
            text(&message["topic"]),
            text(&message["type"]),
            message["log_time_ns"].as_i64().unwrap(),
            message["bytes"].as_u64().unwrap(),
            u32::try_from(message["crc32"].as_u64().unwrap()).unwrap(),
        )
    };
    lists.into_iter().map(|(name, list)| (name, list.iter().map(line).collect())).collect()
}

fn line(told: &Told) -> Line {
    let data = told.data.as_slice();
    let (topic, message_type) = (told.topic.clone(), told.message_type.clone());
    (topic, message_type, told.log_time_ns, data.len() as u64, crc32fast::hash(data))
}

#[test]
fn every_message_is_what_others_read() {
    let oracle = oracle();
    assert_eq!(oracle.len(), 13);
    for (name, listed) in oracle {
        let told = scan_whole(&open(&fixture(&name)).unwrap());
        assert_eq!(told.iter().map(line).collect::<Vec<_>>(), listed, "{name}");
    }
}

#[test]
fn any_message_is_found_again_by_several_threads_in_any_order() {
    for name in oracle().into_keys() {
        let bag = open(&fixture(&name)).unwrap();
        let told = scan_whole(&bag);
        std::thread::scope(|scope| {
            // Strides without a common divisor with the count take everything once.
            for stride in [1, 5, 7, 23] {
                let (bag, told, name) = (&bag, &told, &name);
                scope.spawn(move || {
                    for i in 0..told.len() {
                        let message = &told[i * stride % told.len()];
                        assert_eq!(bag.read(message.locator).unwrap(), message.data, "{name}");
                    }
                });
            }
        });
    }
}

#[test]
fn what_we_note_about_a_recording_is_found() {
    for name in ["none.mcap", "lz4.mcap", "zstd.mcap", "unchunked.mcap", "no_summary.mcap"] {
        let bag = open(&fixture(name)).unwrap();
        assert_eq!(bag.metadata().unwrap()["base"], "base_link", "{name}");
    }
    assert_eq!(open(&fixture("sqlite")).unwrap().metadata(), None);
}
