//! Data sets that cannot be, seen from `eyebolt label`.

use crate::desk::{Desk, text};
use crate::folder::{GOOD, Recorded};
use crate::run::{CACHE, Ended, command, end, eyebolt, start};
use std::fs;
use std::path::{Path, PathBuf};

/// No file may become larger than 512 bytes (1 KiB with some shells).
const TINY_FILES: &str = "trap '' XFSZ; ulimit -f 1;";

fn label_after(before: &str, recording: &Path, output: &Path, more: &[&str]) -> Ended {
    let (output, cache) = (text(output), text(CACHE.path()));
    let arguments = ["label", text(recording), "--output", output, "--cache", cache];
    end(start(&mut command(before, &[&arguments, more].concat())))
}

fn label(recording: &Path, output: &Path, more: &[&str]) -> Ended {
    label_after("", recording, output, more)
}

/// Two frames with a calibration that is given, labelled in no time.
struct Labelled {
    desk: Desk,
    recorded: Recorded,
    calibration: PathBuf,
    set: PathBuf,
}

impl Labelled {
    fn new() -> Self {
        let (desk, recorded) = (Desk::new(), Recorded::two());
        let (calibration, set) = (desk.file("calibration.json"), desk.file("set"));
        fs::write(&calibration, &*GOOD).unwrap();
        let labelled = Self { desk, recorded, calibration, set };
        let ended = labelled.again(&[]);
        assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
        labelled
    }

    fn again(&self, more: &[&str]) -> Ended {
        let given = ["--calibration", text(&self.calibration)];
        label(self.recorded.path(), &self.set, &[&given, more].concat())
    }

    fn frame(&self) -> PathBuf {
        let folder = fs::read_dir(self.set.join("frames")).unwrap().next().unwrap().unwrap().path();
        let mut frames: Vec<_> =
            fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
        frames.sort();
        frames.remove(0)
    }
}

#[test]
fn a_data_set_of_another_robot() {
    let labelled = Labelled::new();
    let before = fs::read(labelled.set.join("index.jsonl")).unwrap();
    labelled.recorded.replace("arm.urdf", "<link name=\"base\">", "<link name=\"base\"><!-- -->");
    labelled.again(&[]).assert_error(&["dataset.toml", "robot.urdf_hash", "another folder"]);
    assert_eq!(fs::read(labelled.set.join("index.jsonl")).unwrap(), before);
}

#[test]
fn another_calibration_of_frames_that_are_there() {
    let labelled = Labelled::new();
    let other = GOOD.replacen("\"seed\": 1", "\"seed\": 2", 1);
    assert_ne!(other, *GOOD);
    fs::write(&labelled.calibration, other).unwrap();
    labelled.again(&[]).assert_error(&[
        "calibration.json",
        "another one already",
        "another folder",
    ]);
}

#[test]
fn a_frame_that_was_cut_while_no_index_knew_of_it() {
    let labelled = Labelled::new();
    let frame = labelled.frame();
    fs::remove_file(labelled.set.join("index.jsonl")).unwrap();
    let whole = fs::read(&frame).unwrap();
    fs::write(&frame, &whole[..whole.len() / 3]).unwrap();
    labelled.again(&[]).assert_error(&[".npz", "archive", "cut short", "remove it"]);
}

#[test]
fn an_index_that_was_cut() {
    let labelled = Labelled::new();
    let index = labelled.set.join("index.jsonl");
    let text = fs::read(&index).unwrap();
    fs::write(&index, &text[..text.len() - 20]).unwrap();
    labelled.again(&[]).assert_error(&["index.jsonl", "line 2", "Remove the file"]);
}

#[test]
fn a_description_that_is_none() {
    let labelled = Labelled::new();
    fs::write(labelled.set.join("dataset.toml"), "schema = 3").unwrap();
    labelled.again(&[]).assert_error(&["dataset.toml", "text", "label again"]);
}

#[test]
fn no_room_on_the_disk() {
    let (desk, recorded) = (Desk::new(), Recorded::two());
    let (calibration, set) = (desk.file("calibration.json"), desk.file("set"));
    fs::write(&calibration, &*GOOD).unwrap();
    let given = ["--calibration", text(&calibration)];
    let ended = label_after(TINY_FILES, recorded.path(), &set, &given);
    ended.assert_error(&["set/dataset.toml", "cannot write", "Make room there", "--output"]);
    // Not even half a file.
    assert_eq!(fs::read_dir(&set).unwrap().count(), 0);
}

#[test]
fn an_end_effector_without_shape() {
    let (desk, recorded) = (Desk::new(), Recorded::two());
    let tip = "<link name=\"tip\"/><joint name=\"end\" type=\"fixed\"><parent link=\"hand\"/>\
               <child link=\"tip\"/></joint></robot>";
    recorded.replace("arm.urdf", "</robot>", tip);
    let ended = label(recorded.path(), &desk.file("set"), &["--end-effector", "tip"]);
    ended.assert_error(&["end-effector tip has no visual", "--end-effector"]);
    assert!(desk.names().is_empty());
}

#[test]
fn a_calibration_of_another_base() {
    let (desk, recorded) = (Desk::new(), Recorded::two());
    let calibration = desk.file("calibration.json");
    fs::write(&calibration, GOOD.replacen("\"base\": \"base\"", "\"base\": \"socle\"", 1)).unwrap();
    let given = ["--calibration", text(&calibration)];
    let ended = label(recorded.path(), &desk.file("set"), &given);
    ended.assert_error(&["calibration.json", "frames.base", "socle", "--base"]);
    assert_eq!(desk.names(), ["calibration.json"]);
}

#[test]
fn places_where_no_data_set_can_be() {
    let (desk, recorded) = (Desk::new(), Recorded::two());
    let set = desk.file("set");
    fs::write(&set, "precious").unwrap();
    label(recorded.path(), &set, &[]).assert_error(&["set", "--output", "not a folder"]);
    label(recorded.path(), desk.path(), &[]).assert_error(&["--output", "another folder"]);
    assert_eq!(fs::read(&set).unwrap(), b"precious");
    assert_eq!(desk.names(), ["set"]);
}

#[test]
fn shards_that_are_none() {
    let desk = Desk::new();
    for (shard, word) in [("2/2", "1/2"), ("0/0", "0/1"), ("one", "I/N")] {
        let ended = label(desk.path(), &desk.file("set"), &["--shard", shard]);
        assert_eq!(ended.code, Some(2), "{}", ended.err);
        assert!(ended.err.contains("--shard") && ended.err.contains(word), "{}", ended.err);
    }
    assert!(desk.names().is_empty());
}

#[test]
fn shards_of_which_one_is_missing() {
    let labelled = Labelled::new();
    let set = labelled.desk.file("shards");
    let given = ["--calibration", text(&labelled.calibration), "--shard", "0/3"];
    assert_eq!(label(labelled.recorded.path(), &set, &given).code, Some(0));
    let merged = eyebolt(&["label", "--merge", text(&set)]);
    merged.assert_error(&["shards", "shard 1/3 is missing", "Run shard 1/3"]);
    let nothing = eyebolt(&["label", "--merge", text(&labelled.set)]);
    nothing.assert_error(&["set", "no indices of shards"]);
    eyebolt(&["label", "--merge", "nowhere"])
        .assert_error(&["nowhere/dataset.toml", "cannot read"]);
}
