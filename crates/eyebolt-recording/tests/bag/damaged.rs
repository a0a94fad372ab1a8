//! Damaged messages and files, with and without `partial`.

use super::sample::{Bag, DEPTH_TOPIC, INFO_TOPIC, assert_says};
use eyebolt_recording::{BagOptions, BagRecording, FrameSource, Recording};

#[test]
fn a_damaged_frame_is_an_error_or_dropped() {
    let names = Bag::sample().open().frame_names().to_vec();
    type Damage = fn(&mut Vec<u8>);
    let damages: [(Damage, &str); 3] = [
        (|data| data.truncate(data.len() - 5), "data: takes 48 bytes, but 43 are left"),
        (|data| data.truncate(9), "header.stamp.nanosec"),
        // Bytes of a row.
        (|data| data[52] = 3, "step: 3 bytes do not hold"),
    ];
    for (damage, said) in damages {
        let mut bag = Bag::sample();
        damage(&mut bag.on(DEPTH_TOPIC)[2].data);
        bag.assert_says(&[DEPTH_TOPIC, said, "message of 1700000000.205 s", "`partial`"]);
        bag.options.partial = true;
        let bag = bag.open();
        let (index, reason) = bag.reasons().remove(0);
        assert!(index == 2 && reason.contains(said), "{reason}");
        // The others keep their numbers.
        assert_eq!(bag.frame_names(), [&names[..2], &names[3..]].concat());
        assert!(bag.problems(DEPTH_TOPIC)[0].contains("1 message cannot be read"));
    }
}

#[test]
fn frames_unlike_the_first_are_refused() {
    let mut bag = Bag::sample();
    let stamp = bag.on(DEPTH_TOPIC)[4].log_time_ns;
    bag.on(DEPTH_TOPIC)[4].data = super::writer::depth(stamp, "", (2, 2), &[1.0; 4]);
    bag.assert_says(&[DEPTH_TOPIC, "the picture is 2 x 2 in 32FC1, the first 4 x 3 in 32FC1"]);
    bag.options.partial = true;
    assert_eq!(bag.open().reasons()[0].0, 4);
}

#[test]
fn damage_of_other_topics_is_told_only() {
    let mut bag = Bag::sample();
    bag.add("/other/image", "sensor_msgs/Image", super::sample::START_NS, vec![0, 1, 0, 0, 9]);
    assert_eq!(bag.open().frame_names(), Bag::sample().open().frame_names());
    let mut needed = Bag::sample();
    needed.on(INFO_TOPIC)[0].data.truncate(60);
    needed.assert_says(&["no topic has the intrinsics"]);
}

#[test]
fn what_a_killed_recorder_left_can_be_used() {
    let (_folder, path) = Bag::sample().write();
    let bytes = std::fs::read(&path).unwrap();
    let whole = BagRecording::open(&path, &BagOptions::default()).unwrap();
    std::fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
    let cut = BagRecording::open(&path, &BagOptions::default());
    assert_says(cut, &["bag.mcap: record at byte", "`mcap recover`", "`partial`"]);
    let options = BagOptions { partial: true, ..Default::default() };
    let part = BagRecording::open(&path, &options).unwrap();
    assert_eq!(part.damage().len(), 1);
    let count = part.frame_names().len();
    assert!(count > 10 && count < whole.frame_names().len());
    assert_eq!(part.frame_names(), &whole.frame_names()[..count]);
    for index in 0..count {
        part.read_frame(index).unwrap();
    }
}

#[test]
fn recordings_are_of_either_kind() {
    let (folder, path) = Bag::sample().write();
    let options = BagOptions::default();
    for place in [path.as_path(), folder.path()] {
        let recording = Recording::open(place, &options).unwrap();
        assert!(recording.bag().is_some() && !recording.has_masks());
        assert_eq!(recording.camera_frame_id(), Some(super::sample::FRAME));
    }
    // A description of a folder comes before a bag in it.
    std::fs::write(folder.path().join("recording.toml"), "").unwrap();
    assert_says(Recording::open(folder.path(), &options), &["recording.toml"]);
    let empty = tempfile::tempdir().unwrap();
    assert_says(Recording::open(empty.path(), &options), &["recording.toml"]);
}
