//! Sessions that are read while they are written, or after their writer was killed.

use crate::sample::{Backgrounds, Desk, assert_says, open, write};
use eyebolt_recording::{
    BagOptions, BagRecording, FrameSource, Glimpse, GrowingRecording, Provenance, SessionWriter,
    glimpse,
};
use proptest::prelude::*;
use std::fs::{self, File};
use std::path::Path;

/// Topic, type, time and bytes of every message of a recording.
fn messages(desk: &Desk) -> Vec<(String, String, i64, Vec<u8>)> {
    let path = desk.record("recorded.mcap", true, |writer| write(writer, Backgrounds::None));
    let file = fs::read(path).unwrap();
    let stream = mcap::MessageStream::new(&file).unwrap().map(|message| {
        let message = message.unwrap();
        let schema = message.channel.schema.as_ref().unwrap().name.clone();
        let time = message.log_time.try_into().unwrap();
        (message.channel.topic.clone(), schema, time, message.data.to_vec())
    });
    stream.collect()
}

/// All that can be known of a recording, but for the path and what is said of its end.
fn known(recording: &BagRecording) -> (Provenance, Vec<String>) {
    let provenance = Provenance { damage: Vec::new(), ..recording.provenance().clone() };
    let frames = (0..recording.frame_names().len()).map(|index| {
        format!("{:?} {:?}", recording.read_frame(index).unwrap(), recording.stamp_ns(index))
    });
    (provenance, frames.collect())
}

fn whole(path: &Path) -> BagRecording {
    BagRecording::open(path, &BagOptions::default()).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Whenever it is looked at: what is there so far is what a reader of the file finds, and at the end it is the recording
    /// that was copied.
    #[test]
    fn a_session_is_a_recording_at_any_time(looks in proptest::collection::btree_set(0..70_usize, 0..9)) {
        let desk = Desk::new();
        let heard = messages(&desk);
        let path = desk.file("session.mcap");
        let mut writer = SessionWriter::new(File::create(&path).unwrap()).unwrap();
        let mut growing = GrowingRecording::new(&path, BagOptions::default());
        for (number, (topic, kind, time, data)) in heard.iter().enumerate() {
            writer.write(topic, kind, *time, data).unwrap();
            if looks.contains(&number) {
                writer.flush().unwrap();
                match (growing.now(), BagRecording::open(&path, &BagOptions::default())) {
                    (Ok(now), Ok(opened)) => prop_assert_eq!(known(&now), known(&opened)),
                    // In the beginning there are no frames yet.
                    (Err(now), Err(opened)) => prop_assert_eq!(now.to_string(), opened.to_string()),
                    (now, opened) => prop_assert!(false, "{:?} {:?}", now.err(), opened.err()),
                }
            }
        }
        writer.finish().unwrap();
        let (now, opened) = (growing.now().unwrap(), whole(&path));
        prop_assert_eq!(known(&now), known(&opened));
        prop_assert!(opened.damage().is_empty());
        let recorded = open(&desk.file("recorded.mcap"));
        prop_assert_eq!(opened.frame_names(), recorded.frame_names());
        prop_assert_eq!(known(&opened).1, known(recorded.bag().unwrap()).1);
    }
}

#[test]
fn a_session_that_was_killed_is_read_to_its_end_and_other_files_are_not() {
    let desk = Desk::new();
    let heard = messages(&desk);
    let path = desk.file("session.mcap");
    let mut writer = SessionWriter::new(File::create(&path).unwrap()).unwrap();
    for (topic, kind, time, data) in &heard {
        writer.write(topic, kind, *time, data).unwrap();
    }
    writer.flush().unwrap();
    std::mem::forget(writer);
    let killed = whole(&path);
    assert_eq!(killed.frame_names().len(), 5);
    assert_eq!(killed.damage().len(), 1);
    assert!(killed.damage()[0].contains("as when a recorder is killed"), "{:?}", killed.damage());

    // Cut within its last chunk, which here is the only one with frames: there is nothing before.
    let bytes = fs::read(&path).unwrap();
    fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
    assert_says(BagRecording::open(&path, &BagOptions::default()), &["session.mcap"]);

    // A file of others may have lost anything.
    let recorded = fs::read(desk.file("recorded.mcap")).unwrap();
    let other = desk.file("other.mcap");
    // Within the chunk that has its messages.
    let mut chunk = 8;
    while recorded[chunk] != mcap::records::op::CHUNK {
        chunk +=
            9 + u64::from_le_bytes(recorded[chunk + 1..chunk + 9].try_into().unwrap()) as usize;
    }
    fs::write(&other, &recorded[..chunk + 20]).unwrap();
    assert_says(BagRecording::open(&other, &BagOptions::default()), &["mcap recover", "`partial`"]);
}

#[test]
fn what_no_recording_needs_is_not_written() {
    let desk = Desk::new();
    let path = desk.file("session.mcap");
    let mut writer = SessionWriter::new(File::create(&path).unwrap()).unwrap();
    writer.write("/rosout", "rcl_interfaces/msg/Log", 5, &[0, 1, 0, 0]).unwrap();
    writer.finish().unwrap();
    let file = fs::read(&path).unwrap();
    assert_eq!(mcap::MessageStream::new(&file).unwrap().count(), 0);
}

#[test]
fn a_glimpse_tells_what_a_reader_finds() {
    let desk = Desk::new();
    let (mut images, mut joints) = (0, 0);
    for (_, kind, time, data) in messages(&desk) {
        match glimpse(&kind, &data).unwrap() {
            Glimpse::Depth { stamp_ns, samples } => {
                images += 1;
                assert_eq!((stamp_ns, samples.len()), (time, 12));
                assert!(
                    samples.iter().all(|depth| (1000.0..1200.0).contains(depth)),
                    "{samples:?}"
                );
            }
            Glimpse::Joints { stamp_ns, positions } => {
                joints += 1;
                assert_eq!((stamp_ns, positions.get("elbow")), (time, Some(0.75)));
            }
            Glimpse::Description(text) => assert_eq!(text, crate::sample::URDF),
            Glimpse::Transforms(told) => assert_eq!(told, crate::sample::transforms()),
            Glimpse::Picture => panic!("{kind}"),
            Glimpse::Other => assert_eq!(kind, "sensor_msgs/msg/CameraInfo"),
        }
    }
    assert_eq!((images, joints), (5, 60));
}
