//! The truth is in a record of its own, and nowhere else.

use crate::stage::{Recorded, assert_same, bytes, planned, small};
use eyebolt::simulate::Scenario;
use mcap::records::Record;
use std::collections::BTreeMap;

/// Whatever an MCAP holds: messages by topic, metadata by name.
fn contents(mcap: &[u8]) -> (Vec<Vec<u8>>, BTreeMap<String, String>) {
    let messages = mcap::MessageStream::new(mcap).unwrap();
    let messages = messages.map(|message| message.unwrap().data.into_owned()).collect();
    let mut metadata = BTreeMap::new();
    for record in mcap::read::LinearReader::new(mcap).unwrap() {
        if let Record::Metadata(record) = record.unwrap() {
            let text = format!("{:?}", record.metadata);
            *metadata.entry(record.name).or_default() += text.as_str();
        }
    }
    (messages, metadata)
}

fn contains(haystack: &[u8], needle: &[u8]) -> bool {
    haystack.windows(needle.len()).any(|window| window == needle)
}

#[test]
fn no_message_and_no_other_record_has_a_number_of_the_truth() {
    let mut scenario = Scenario { backgrounds: 1, frames: 1, seed: 123_456_789, ..small() };
    scenario.faults.depth_scale = 1.012_345;
    let plan = planned(scenario);
    let bytes = bytes(&plan);
    let (messages, metadata) = contents(&bytes);
    let pose = plan.camera_from_base();
    let (forth, back) = (pose.matrix(), pose.inverse().matrix());
    let turn = pose.rotation_xyzw().into_iter().chain(pose.inverse().rotation_xyzw());
    let numbers: Vec<f64> = forth.iter().chain(back.iter()).copied().chain(turn).collect();
    let numbers = numbers.into_iter().filter(|number| number.fract() != 0.0);
    let numbers: Vec<f64> = numbers.chain([1.012_345]).collect();
    assert!(numbers.len() > 24);
    let texts: Vec<String> = numbers.iter().map(|number| format!("{:.6}", number.abs())).collect();
    let texts = texts.iter().map(|text| &text[..text.len() - 1]).chain(["123456789", "paper-test"]);
    let texts: Vec<&str> = texts.collect();
    let tells = |text: &[u8]| {
        let spelled = texts.iter().filter(|needle| contains(text, needle.as_bytes())).count();
        let stored = numbers.iter().filter(|number| {
            contains(text, &number.to_le_bytes())
                || contains(text, &(**number as f32).to_le_bytes())
        });
        // Of four bytes, some will be met by chance in an image: not so of eight.
        spelled + if text.len() > 100_000 { 0 } else { stored.count() }
    };
    assert!(messages.len() > 100);
    assert_eq!(messages.iter().map(|message| tells(message)).sum::<usize>(), 0);
    let records: Vec<&str> = metadata.keys().map(String::as_str).collect();
    assert_eq!(records, ["eyebolt", "eyebolt.truth"]);
    assert_eq!(tells(metadata["eyebolt"].as_bytes()), 0, "{}", metadata["eyebolt"]);
    assert!(tells(metadata["eyebolt.truth"].as_bytes()) > 12, "the search finds what is there");
    assert!(messages.iter().any(|message| contains(message, b"<robot name=")));
}

/// Joints, depth and intrinsics are stored bit by bit, so that what they are is found as well.
#[test]
fn nothing_that_readers_tell_depends_on_the_truth_record() {
    let plan = planned(small());
    let whole = Recorded::of_plan(&plan);
    assert_same(&whole.truth.camera_from_base, &plan.camera_from_base());
    assert_eq!((whole.truth.seed, whole.truth.sensor.as_str()), (7, "ideal"));
    let mut bytes = bytes(&plan);
    // The same file with another number in the truth, which is text.
    let place = bytes.windows(8).position(|window| window == b"\"seed\": ").unwrap() + 8;
    assert_eq!(bytes[place], b'7');
    bytes[place] = b'9';
    let other = Recorded::of_bytes(&bytes);
    assert_eq!(other.truth.seed, 9);
    assert_eq!(other.joints(), whole.joints());
    assert!((0..whole.count()).all(|frame| other.depth(frame) == whole.depth(frame)));
    assert_eq!(format!("{:?}", other.recording.robot()), format!("{:?}", whole.recording.robot()));
}
