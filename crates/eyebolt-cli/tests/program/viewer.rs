//! `eyebolt calibrate --viewer-mcap`.

use crate::desk::{Desk, text};
use crate::program::{RECORDING, calibrate, eyebolt};
use serde_json::Value;
use std::fs;

#[test]
fn a_file_for_viewers_and_its_layout_are_written_and_said() {
    let desk = Desk::new();
    let file = desk.file("viewer.mcap");
    let ended = desk.calibrate(&["--viewer-mcap", text(&file)]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(ended.out.contains(&format!("\nfor viewers in {}", text(&file))), "{}", ended.out);
    assert_eq!(desk.names(), ["calibration.json", "viewer.layout.json", "viewer.mcap"]);
    let layout = fs::read(desk.file("viewer.layout.json")).unwrap();
    assert!(serde_json::from_slice::<Value>(&layout).unwrap()["configById"].is_object());
    let bytes = fs::read(&file).unwrap();
    assert!(bytes.starts_with(b"\x89MCAP0\r\n") && bytes.len() < 4 << 20, "{}", bytes.len());
    // The same bytes, on any number of threads.
    let again = desk.file("again.mcap");
    desk.calibrate(&["--viewer-mcap", text(&again), "--force", "--threads", "1"]);
    assert!(fs::read(again).unwrap() == bytes);
}

#[test]
fn nothing_is_written_over_least_of_all_the_recording() {
    let desk = Desk::new();
    let recording = desk.file("session.mcap");
    let ended = eyebolt(&["convert", text(&RECORDING), text(&recording)]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let before = fs::read(&recording).unwrap();
    let output = desk.file("calibration.json");
    let ended = calibrate(&recording, &output, &["--viewer-mcap", text(&recording), "--force"]);
    ended.assert_error(1, &["session.mcap", "the recording itself"]);
    assert!(fs::read(&recording).unwrap() == before);
    fs::write(desk.file("viewer.layout.json"), "precious").unwrap();
    for (name, words) in [
        ("viewer.mcap", ["viewer.layout.json", "exists", "--force"]),
        ("viewer.bag", ["--viewer-mcap", "an MCAP", "ends in .mcap"]),
        ("", ["--viewer-mcap", "this is a folder", "Name a file"]),
    ] {
        let file = if name.is_empty() { desk.path().to_owned() } else { desk.file(name) };
        let ended = calibrate(&recording, &output, &["--viewer-mcap", text(&file)]);
        ended.assert_error(1, &words);
    }
    let layout = desk.file("calibration.layout.json");
    let file = desk.file("calibration.mcap");
    let ended = calibrate(&recording, &layout, &["--viewer-mcap", text(&file)]);
    ended.assert_error(1, &["calibration.layout.json", "the calibration goes there"]);
    assert_eq!(desk.names(), ["session.mcap", "viewer.layout.json"]);
}

#[test]
fn without_a_pose_there_is_no_file() {
    let desk = Desk::new();
    let file = desk.file("viewer.mcap");
    let ended = desk.calibrate_stranger(&["--viewer-mcap", text(&file)]);
    assert_eq!(ended.code, Some(3), "{}", ended.err);
    assert!(ended.out.contains("no pose to show"), "{}", ended.out);
    assert_eq!(desk.names(), ["calibration.rejected.json"]);
}
