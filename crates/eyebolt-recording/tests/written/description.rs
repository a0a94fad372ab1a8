//! Which robot description goes into a copy.

use crate::sample::{Backgrounds, Desk, START_NS, URDF, open, write};
use eyebolt_recording::{WriteRobot, write_folder, write_mcap};
use mcap::MessageStream;
use std::fs;
use std::io::Cursor;
use std::path::Path;

const OTHER: &str = "<robot name=\"three links\"/>";

/// `from` as MCAP, with this description given: the file.
fn copy(from: &Path, urdf: Option<&str>) -> Vec<u8> {
    let robot = WriteRobot { urdf: urdf.map(str::to_owned), ..WriteRobot::default() };
    let mut output = Cursor::new(Vec::new());
    let go_on = &();
    write_mcap(&open(from), &robot, &mut output, go_on).unwrap();
    output.into_inner()
}

/// Times and texts of all descriptions in a file, whatever their topics.
fn descriptions(mcap: &[u8]) -> Vec<(u64, String)> {
    let messages = MessageStream::new(mcap).unwrap().map(Result::unwrap);
    let strings = messages.filter(|message| {
        message.channel.schema.as_ref().is_some_and(|schema| schema.name == "std_msgs/msg/String")
    });
    let text = |data: &[u8]| String::from_utf8(data[8..data.len() - 1].to_vec()).unwrap();
    strings.map(|message| (message.log_time, text(&message.data))).collect()
}

#[test]
fn the_one_that_is_given_replaces_the_bags_own() {
    let desk = Desk::new();
    let bag = desk.record("a.mcap", false, |writer| write(writer, Backgrounds::None));
    let own = descriptions(&fs::read(&bag).unwrap());
    assert_eq!(own.len(), 1);
    assert_eq!(own[0].1, URDF);
    // Nobody gave one, or the same again: the message is copied with its time.
    assert_eq!(descriptions(&copy(&bag, None)), own);
    assert_eq!(descriptions(&copy(&bag, Some(URDF))), own);
    let replaced = desk.file("b.mcap");
    fs::write(&replaced, copy(&bag, Some(OTHER))).unwrap();
    let texts: Vec<_> =
        descriptions(&fs::read(&replaced).unwrap()).into_iter().map(|(_, text)| text).collect();
    assert_eq!(texts, [OTHER]);
    assert_eq!(open(&replaced).robot().description.as_deref(), Some(OTHER));
    // Everything else is there.
    assert_eq!(open(&replaced).frame_names().len(), 5);
    assert!(open(&replaced).stamp_ns(0) == START_NS);
}

#[test]
fn a_folder_has_the_one_that_is_given() {
    let desk = Desk::new();
    let bag = desk.record("a.mcap", false, |writer| write(writer, Backgrounds::None));
    let folder = desk.file("folder");
    fs::create_dir(&folder).unwrap();
    let robot = WriteRobot { urdf: Some(OTHER.to_owned()), ..WriteRobot::default() };
    let go_on = &();
    write_folder(&open(&bag), &robot, &folder, go_on).unwrap();
    assert_eq!(fs::read_to_string(folder.join("robot.urdf")).unwrap(), OTHER);
}
