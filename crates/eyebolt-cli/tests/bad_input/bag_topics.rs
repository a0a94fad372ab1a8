//! Bags whose messages are not those of a recording.

use crate::bag::{Mcap, channel, channels, depth, message, seconds, time_ns};
use crate::desk::{Desk, text};
use crate::outcome::{assert_not_calibrated, assert_unusable};
use crate::run::eyebolt;
use std::fs;

/// Checks that nothing can be made of a bag of these records.
#[track_caller]
fn assert_unusable_bag(records: &[u8], words: &[&str]) {
    let desk = Desk::new();
    let path = desk.file("bag.mcap");
    fs::write(&path, Mcap::new().with(records).finish()).unwrap();
    assert_unusable(&path, &[&["bag.mcap"], words].concat());
}

/// What the rows of this table spoil is a bag that can be read.
#[test]
fn the_unspoilt_bag() {
    let desk = Desk::new();
    let path = desk.file("bag.mcap");
    let bytes = Mcap::new().with(&channels()).with(&seconds(2)).finish();
    fs::write(&path, bytes).unwrap();
    let ended = eyebolt(&["info", text(&path)]);
    // No robot is in it, so that it is not ready.
    assert_eq!((ended.code, ended.err.as_str()), (Some(3), ""));
    assert!(ended.out.contains("60 take part"), "{}", ended.out);
}

#[test]
fn depth_on_two_topics() {
    let mut records = [channels(), channel(9, "/other/depth/image_raw", "Image")].concat();
    records.extend(seconds(1));
    records.extend((0..30).flat_map(|frame| message(9, time_ns(frame), &depth(time_ns(frame)))));
    let topics = ["/camera/depth/image_raw", "/other/depth/image_raw"];
    let desk = Desk::new();
    let path = desk.file("bag.mcap");
    fs::write(&path, Mcap::new().with(&records).finish()).unwrap();
    let words = [&topics[..], &["bag.mcap", "--depth-topic", "Give one of them"]].concat();
    assert_not_calibrated(&path, &[], &words);
    // It can be looked at all the same.
    let ended = eyebolt(&["info", text(&path)]);
    assert_eq!((ended.code, ended.err.as_str()), (Some(3), ""));
    let advice = "several topics have depth, and this is of /camera/depth/image_raw: give \
                  --depth-topic /camera/depth/image_raw";
    assert!(ended.out.contains(advice) && ended.out.contains("30 take part"), "{}", ended.out);
    let named = eyebolt(&["info", text(&path), "--depth-topic", "/camera/depth/image_raw"]);
    assert!(!named.out.contains("several topics"), "{}", named.out);
}

#[test]
fn no_joint_states() {
    let records = channel(1, "/camera/depth/image_raw", "Image");
    let frames = (0..30).flat_map(|frame| message(1, time_ns(frame), &depth(time_ns(frame))));
    let records: Vec<u8> = records.into_iter().chain(frames).collect();
    assert_unusable_bag(&records, &["--joint-topic", "joint states", "/camera/depth/image_raw"]);
}

#[test]
fn no_messages_at_all() {
    assert_unusable_bag(&channels(), &["the bag: it is empty", "ros2 topic hz"]);
}

#[test]
fn stamps_that_run_backward() {
    let mut records = [channels(), seconds(1)].concat();
    let backward = (0..30).rev().map(time_ns);
    records.extend(backward.flat_map(|stamp| message(1, stamp, &depth(stamp))));
    let words = ["/camera/depth/image_raw", "stamps run backward", "record it again"];
    assert_unusable_bag(&records, &words);
}
