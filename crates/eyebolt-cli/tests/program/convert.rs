//! `eyebolt convert`: there and back, and what it will not overwrite.

use crate::desk::{Desk, text};
use crate::good::parsed;
use crate::program::{RECORDING, calibrate, eyebolt};
use serde_json::Value;
use std::fs;
use std::path::Path;

fn convert(from: &Path, to: &Path, more: &[&str]) -> crate::program::Ended {
    let mut arguments = vec!["convert", text(from), text(to)];
    arguments.extend(more);
    eyebolt(&arguments)
}

/// The answer of a recording, without what tells where it came from.
fn answer(desk: &Desk, recording: &Path) -> Value {
    let output = desk.file("answer.json");
    let ended = calibrate(recording, &output, &["--force"]);
    assert_eq!(ended.code, Some(0), "{}{}", ended.out, ended.err);
    let mut answer: Value = serde_json::from_slice(&fs::read(output).unwrap()).unwrap();
    // Its name in the text of the URDF stays, its file does not.
    answer.as_object_mut().unwrap().remove("urdf_hash");
    answer
}

#[test]
fn there_and_back_the_answer_is_the_same() {
    let desk = Desk::new();
    let (mcap, folder, again) = (desk.file("a.mcap"), desk.file("b"), desk.file("c.mcap"));
    for (from, to) in [(RECORDING.as_path(), &mcap), (&mcap, &folder), (&folder, &again)] {
        let ended = convert(from, to, &[]);
        assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
        let said = format!("5 frames, written to {}\n", text(to));
        assert!(ended.out.starts_with(&said), "{}", ended.out);
    }
    let mut good = parsed();
    good.as_object_mut().unwrap().remove("urdf_hash");
    for recording in [&mcap, &folder, &again] {
        assert_eq!(answer(&desk, recording), good, "{}", recording.display());
    }
    // Nothing that is not an answer is left over.
    assert_eq!(desk.names(), ["a.mcap", "answer.json", "b", "c.mcap"]);
    // The same input, the same bytes.
    let twice = desk.file("d.mcap");
    assert_eq!(convert(&RECORDING, &twice, &[]).code, Some(0));
    assert!(fs::read(&twice).unwrap() == fs::read(&mcap).unwrap());
}

#[test]
fn what_exists_is_replaced_only_when_told() {
    let desk = Desk::new();
    let (file, folder) = (desk.file("a.mcap"), desk.file("folder"));
    fs::write(&file, "precious").unwrap();
    fs::create_dir(&folder).unwrap();
    fs::write(folder.join("letter.txt"), "precious").unwrap();
    convert(&RECORDING, &file, &[]).assert_error(1, &["a.mcap", "exists", "--force"]);
    convert(&RECORDING, &folder, &[]).assert_error(1, &["folder", "exists", "--force"]);
    assert_eq!(fs::read_to_string(&file).unwrap(), "precious");
    // Not even when told, if it is no recording.
    convert(&RECORDING, &folder, &["--force"]).assert_error(1, &["folder", "no recording"]);
    assert_eq!(fs::read_to_string(folder.join("letter.txt")).unwrap(), "precious");
    assert_eq!(convert(&RECORDING, &file, &["--force"]).code, Some(0));
    assert!(fs::read(&file).unwrap().starts_with(b"\x89MCAP0\r\n"));
    fs::write(folder.join("recording.toml"), "").unwrap();
    assert_eq!(convert(&file, &folder, &["--force"]).code, Some(0));
    assert!(!folder.join("letter.txt").exists() && folder.join("joints.csv").exists());
    assert_eq!(desk.names(), ["a.mcap", "folder"]);
}

#[test]
fn a_recording_is_not_written_over_itself() {
    let desk = Desk::new();
    let file = desk.file("a.mcap");
    assert_eq!(convert(&RECORDING, &file, &[]).code, Some(0));
    let before = fs::read(&file).unwrap();
    convert(&file, &file, &["--force"]).assert_error(1, &["a.mcap", "the recording itself"]);
    assert!(fs::read(&file).unwrap() == before);
}

#[test]
fn what_is_not_written_is_said_so() {
    for name in ["a.bag", "a.db3", "a.mcap.zstd"] {
        let ended = convert(&RECORDING, Path::new(name), &[]);
        ended.assert_error(1, &[name, "not written", ".mcap, or a folder"]);
    }
}

#[test]
fn a_recording_that_cannot_be_read_leaves_nothing() {
    let desk = Desk::new();
    let recording = desk.file("recording");
    fs::create_dir(&recording).unwrap();
    for file in fs::read_dir(&*RECORDING).unwrap() {
        let file = file.unwrap().path();
        fs::copy(&file, recording.join(file.file_name().unwrap())).unwrap();
    }
    fs::write(recording.join("depth_4.npy"), "no array").unwrap();
    for name in ["out.mcap", "out"] {
        let ended = convert(&recording, &desk.file(name), &[]);
        ended.assert_error(1, &["depth_4.npy", "NPY"]);
    }
    assert_eq!(desk.names(), ["recording"]);
}
