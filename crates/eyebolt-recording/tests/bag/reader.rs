//! Bags from whatever reads and seeks.

use super::sample::{Bag, assert_says};
use eyebolt_recording::{BagRecording, FrameSource, Range};
use std::io::Cursor;

#[test]
fn bytes_in_memory_are_the_same_recording() {
    let bag = Bag::sample();
    let (_folder, path) = bag.write();
    let bytes = std::fs::read(path).unwrap();
    let there = bag.open();
    let here = BagRecording::from_reader("a queue", Cursor::new(bytes), &bag.options).unwrap();
    assert_eq!(here.frame_names(), there.frame_names());
    assert_eq!(here.dropped_frames(), there.dropped_frames());
    assert_eq!(here.provenance().name, "a queue");
    for index in [0, here.frame_names().len() - 1] {
        let [here, there] = [here.read_frame(index), there.read_frame(index)].map(Result::unwrap);
        let [Range::Depth(a), Range::Depth(b)] = [here.range, there.range] else {
            panic!("clouds")
        };
        assert_eq!((a, here.joints), (b, there.joints));
    }
}

#[test]
fn errors_call_it_by_its_name() {
    let options = Bag::sample().options;
    let read = BagRecording::from_reader("a queue", Cursor::new(vec![0; 9]), &options);
    assert_says(read, &["a queue", "neither MCAP"]);
    let (_folder, path) = Bag::sample().without("/joint_states").write();
    let bytes = std::fs::read(path).unwrap();
    let read = BagRecording::from_reader("a queue", Cursor::new(bytes), &options);
    assert_says(read, &["a queue: argument `joint_topic`: no topic has joint states"]);
}
