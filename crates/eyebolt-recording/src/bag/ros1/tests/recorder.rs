//! What recorders write beyond what `rosbags` does.

use super::support::{bag, scan_whole};
use super::writer::{connection, message, true_chunk, unindexed};
use crate::bag::{BagFile, Location};
use proptest::prelude::*;

#[test]
fn a_topic_is_of_one_name_and_type() {
    let records = [
        connection(5, "/a", "std_msgs/String"),
        connection(2, "/a", "std_msgs/Header"),
        connection(9, "/a", "std_msgs/String"),
        connection(9, "/a", "std_msgs/String"),
        message(9, [0, 0], b""),
        message(2, [1, 1], b""),
        message(5, [u32::MAX, u32::MAX], b""),
    ];
    let messages = scan_whole(&bag(&unindexed(&records)).1);
    let told: Vec<_> = messages
        .iter()
        .map(|m| (m.topic_index, m.topic.as_str(), m.message_type.as_str(), m.log_time_ns))
        .collect();
    assert_eq!(
        told,
        [
            (0, "/a", "std_msgs/String", 0),
            (1, "/a", "std_msgs/Header", 1_000_000_001),
            (0, "/a", "std_msgs/String", 4_294_967_295_000_000_000 + 4_294_967_295),
        ]
    );
}

/// Messages in the order of the file, each with how its chunk is compressed, if it is in one.
fn layout() -> impl Strategy<Value = Vec<(Option<&'static str>, Vec<Vec<u8>>)>> {
    let compression = prop::sample::select(vec![None, Some("none"), Some("bz2"), Some("lz4")]);
    let data = prop::collection::vec(any::<u8>(), 0..200);
    prop::collection::vec((compression, prop::collection::vec(data, 0..4)), 0..6)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn messages_come_in_order_wherever_they_are(layout in layout()) {
        let mut records = vec![connection(0, "/a", "std_msgs/String")];
        for (compression, data) in &layout {
            let messages = data.iter().map(|data| message(0, [1, 0], data)).collect::<Vec<_>>();
            match compression {
                Some(compression) => records.push(true_chunk(compression, &messages.concat())),
                None => records.extend(messages),
            }
        }
        let (_file, bag) = bag(&unindexed(&records));
        let messages = scan_whole(&bag);
        let told: Vec<_> = messages.iter().map(|m| &m.data).collect();
        let written: Vec<_> = layout.iter().flat_map(|(_, data)| data).collect();
        prop_assert_eq!(told, written);
        for message in &messages {
            prop_assert_eq!(&bag.read(message.place).unwrap(), &message.data);
        }
    }
}

#[test]
fn a_chunk_too_large_to_keep_gives_its_messages() {
    let large = vec![3; 65 << 20];
    let inside = [message(0, [1, 0], b"first"), message(0, [2, 0], &large)].concat();
    let records = [connection(0, "/a", "std_msgs/String"), true_chunk("lz4", &inside)];
    let (_file, bag) = bag(&unindexed(&records));
    let messages = scan_whole(&bag);
    assert!(messages.iter().all(|m| matches!(m.place, Location::InChunk { .. })));
    assert_eq!(bag.read(messages[0].place).unwrap(), b"first");
    assert!(bag.read(messages[1].place).unwrap() == large);
    assert_eq!(bag.read(messages[0].place).unwrap(), b"first");
}
