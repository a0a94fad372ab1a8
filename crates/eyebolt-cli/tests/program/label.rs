//! `eyebolt label`: data sets, whole, in shards, gone on with.

use crate::desk::{Desk, text};
use crate::good::GOOD;
use crate::program::{CACHE, Ended, RECORDING, eyebolt};
use eyebolt::dataset::Dataset;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

/// Runs `eyebolt label` on the shared recording into `output`.
fn label(output: &Path, more: &[&str]) -> Ended {
    let (recording, cache) = (text(&RECORDING), text(&CACHE));
    let arguments = ["label", recording, "--output", text(output), "--cache", cache];
    eyebolt(&[&arguments, more].concat())
}

#[track_caller]
fn assert_labelled(ended: &Ended) {
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
}

/// All files below `folder` with their content.
fn content(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let (mut files, mut left) = (BTreeMap::new(), vec![folder.to_owned()]);
    while let Some(path) = left.pop() {
        if path.is_dir() {
            left.extend(fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
        } else {
            let name = text(path.strip_prefix(folder).unwrap()).to_owned();
            files.insert(name, fs::read(&path).unwrap());
        }
    }
    files
}

/// A data set of the recording, on one thread, with pictures.
struct Labelled {
    desk: Desk,
    ended: Ended,
}

static LABELLED: LazyLock<Labelled> = LazyLock::new(|| {
    let desk = Desk::shared("program-labelled");
    let pictures = desk.file("pictures");
    let ended = label(&desk.file("set"), &["--threads", "1", "--check", text(&pictures)]);
    Labelled { desk, ended }
});

#[test]
fn every_frame_is_labelled_and_told_of() {
    let Labelled { desk, ended } = &*LABELLED;
    assert_labelled(ended);
    for word in ["5 frames labelled", "% background", "% arm", "% end-effector", "% ignored"] {
        assert!(ended.out.contains(word), "no {word:?} in {}", ended.out);
    }
    let dataset = Dataset::open(&desk.file("set")).unwrap();
    assert_eq!((dataset.frames().len(), dataset.left_out().len()), (5, 0));
    for entry in dataset.frames() {
        let pixels = entry.file.pixels;
        assert!(pixels.arm > 1000 && pixels.end_effector > 100, "{pixels:?}");
        dataset.read(entry).unwrap();
    }
    let pictures = fs::read_dir(desk.file("pictures")).unwrap();
    for picture in pictures.map(|entry| entry.unwrap().path()) {
        assert!(fs::read(&picture).unwrap().starts_with(b"\x89PNG"), "{}", picture.display());
    }
    assert_eq!(fs::read_dir(desk.file("pictures")).unwrap().count(), 5);
}

#[test]
fn the_calibration_in_it_is_the_one_that_calibrate_finds() {
    let dataset = Dataset::open(&LABELLED.desk.file("set")).unwrap();
    let recording = dataset.recording(&dataset.frames()[0].recording).unwrap();
    assert_eq!(dataset.calibration(&recording).unwrap(), GOOD.json);
}

#[test]
fn other_threads_and_a_second_run_give_the_same_bytes() {
    let desk = Desk::new();
    let set = desk.file("set");
    assert_labelled(&label(&set, &["--threads", "3"]));
    let whole = content(&LABELLED.desk.file("set"));
    assert_eq!(content(&set), whole);
    // One frame and the index are gone, as after a run that was ended.
    let frame = whole.keys().find(|name| name.ends_with(".npz")).unwrap();
    fs::remove_file(set.join(frame)).unwrap();
    fs::remove_file(set.join("index.jsonl")).unwrap();
    let ended = label(&set, &["--json"]);
    assert_labelled(&ended);
    let told: Value = serde_json::from_str(&ended.out).unwrap();
    assert_eq!((&told["labelled"], &told["known"]), (&5.into(), &4.into()));
    assert_eq!(content(&set), whole);
}

#[test]
fn shards_merged_are_one_run() {
    let desk = Desk::new();
    let set = desk.file("set");
    for shard in ["1/2", "0/2"] {
        assert_labelled(&label(&set, &["--shard", shard]));
    }
    let ended = eyebolt(&["label", "--merge", text(&set)]);
    assert_labelled(&ended);
    assert!(ended.out.contains("5 labelled frames of 1 recordings, 0 left out"), "{}", ended.out);
    assert_eq!(content(&set), content(&LABELLED.desk.file("set")));
}

#[test]
fn a_calibration_that_is_given_is_taken() {
    let desk = Desk::new();
    let (set, given) = (desk.file("set"), GOOD.desk.file("calibration.json"));
    assert_eq!(GOOD.ended.code, Some(0));
    assert_labelled(&label(&set, &["--calibration", text(&given)]));
    let (given, found) = (content(&set), content(&LABELLED.desk.file("set")));
    for (name, bytes) in &found {
        let same = given.get(name) == Some(bytes);
        // Only where the calibration is from differs.
        assert!(same || name.ends_with(".toml"), "{name}");
    }
    let told =
        given.iter().find(|(name, _)| name.starts_with("recordings/") && name.ends_with("toml"));
    assert!(String::from_utf8_lossy(told.unwrap().1).contains("calibrated = \"given\""));
}

#[test]
fn what_is_refused_is_not_labelled() {
    let desk = Desk::new();
    let (set, urdf) = (desk.file("set"), RECORDING.join("other.urdf"));
    let ended = label(&set, &["--robot", text(&urdf)]);
    assert_eq!((ended.code, ended.out.as_str()), (Some(3), ""), "{}", ended.err);
    assert!(ended.err.contains("not labelled") && ended.err.contains("neck"), "{}", ended.err);
    assert!(desk.names().is_empty(), "{:?}", desk.names());
}
