//! `eyebolt batch`: one run, shards, runs that were ended, recordings that are bad.

use crate::desk::{Desk, text};
use crate::good::GOOD;
use crate::program::{CACHE, Ended, RECORDING, eyebolt, eyebolt_in};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::LazyLock;
use std::thread;

/// Recordings, one of them twice, one refused, and two that are none, seen from `desk`.
const RECORDINGS: [&str; 5] = ["good", "again/good", "stranger", "nothing", "missing.mcap"];

/// A folder beside which `in` has the recordings.
fn desk_with_recordings(desk: &Desk) {
    let at = |name: &str| desk.file("in").join(name);
    for name in ["good", "again/good", "stranger", "nothing"] {
        fs::create_dir_all(at(name)).unwrap();
    }
    for name in ["good", "again/good", "stranger"] {
        for entry in fs::read_dir(&*RECORDING).unwrap().map(Result::unwrap) {
            fs::copy(entry.path(), at(name).join(entry.file_name())).unwrap();
        }
    }
    let toml = at("stranger").join("recording.toml");
    let described = fs::read_to_string(&toml).unwrap();
    let other: Vec<&str> = described
        .lines()
        .map(|line| if line.starts_with("urdf") { "urdf = \"other.urdf\"" } else { line })
        .filter(|line| !line.starts_with("base") && !line.starts_with("end_effector"))
        .collect();
    fs::write(&toml, other.join("\n")).unwrap();
    let lines: String = RECORDINGS.iter().map(|name| format!("in/{name}\n")).collect();
    fs::write(desk.file("list.txt"), format!("# recordings\n\n./in//good\n{lines}")).unwrap();
}

/// Runs `eyebolt batch` on all recordings beside `desk`, into `output` there.
fn batch(desk: &Desk, output: &str, more: &[&str]) -> Ended {
    let fixed = ["batch", "--list", "list.txt", "-o", output, "--cache", text(&CACHE)];
    eyebolt_in(desk.path(), &[&fixed, more].concat())
}

#[track_caller]
fn assert_done(ended: &Ended) {
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
}

/// All files below `folder` with their content, but for what a run that was killed was writing.
fn content(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let (mut files, mut left) = (BTreeMap::new(), vec![folder.to_owned()]);
    while let Some(path) = left.pop() {
        if path.is_dir() {
            left.extend(fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
        } else if !path.file_name().unwrap().to_str().unwrap().starts_with(".tmp") {
            let name = text(path.strip_prefix(folder).unwrap()).to_owned();
            files.insert(name, fs::read(&path).unwrap());
        }
    }
    files
}

#[track_caller]
fn assert_same(folder: &Path, whole: &BTreeMap<String, Vec<u8>>) {
    let found = content(folder);
    assert!(found.keys().eq(whole.keys()), "{:?}\n{:?}", found.keys(), whole.keys());
    for (name, bytes) in whole {
        assert!(found.get(name) == Some(bytes), "{name}");
    }
}

/// One run on one thread.
struct Whole {
    desk: Desk,
    ended: Ended,
    content: BTreeMap<String, Vec<u8>>,
}

static WHOLE: LazyLock<Whole> = LazyLock::new(|| {
    let desk = Desk::shared("program-batch");
    desk_with_recordings(&desk);
    let ended = batch(&desk, "whole", &["--threads", "1"]);
    let content = content(&desk.file("whole"));
    Whole { desk, ended, content }
});

fn lines(text: &str) -> Vec<Value> {
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// The line of the recording at `path`.
fn line_of<'a>(lines: &'a [Value], path: &str) -> &'a Value {
    lines.iter().find(|line| line["recording"] == path).unwrap()
}

#[test]
fn every_recording_has_a_line_whatever_became_of_it() {
    let Whole { desk, ended, content } = &*WHOLE;
    assert_done(ended);
    let lines = lines(std::str::from_utf8(&content["batch.jsonl"]).unwrap());
    // The one that is listed twice has one.
    assert_eq!(lines.len(), RECORDINGS.len());
    for path in ["in/good", "in/again/good"] {
        let line = line_of(&lines, path);
        assert_eq!(line["ending"], "trusted", "{line}");
        assert!(line["expected_error"]["translation_mm"].as_f64().unwrap() > 0.0);
        let calibration = line["calibration"].as_str().unwrap();
        assert!(content[calibration] == GOOD.json.as_bytes(), "as `calibrate` writes it");
        let json: Value = serde_json::from_slice(&content[calibration]).unwrap();
        for part in ["translation_m", "rotation_xyzw"] {
            assert_eq!(line["base_from_camera"][part], json["base_from_camera"][part]);
        }
    }
    let refused = line_of(&lines, "in/stranger");
    assert_eq!(refused["ending"], "refused", "{refused}");
    assert!(refused["calibration"].as_str().unwrap().ends_with(".rejected.json"), "{refused}");
    assert!(refused["reasons"][0]["text"].as_str().unwrap().contains("neck"), "{refused}");
    for (path, word) in [("in/nothing", "recording.toml"), ("in/missing.mcap", "missing.mcap")] {
        let failed = line_of(&lines, path);
        assert_eq!((&failed["ending"], &failed["calibration"]), (&"failed".into(), &Value::Null));
        assert!(failed["error"].as_str().unwrap().contains(word), "{failed}");
    }
    for word in
        ["trusted               2", "refused               1", "failed                2", "all "]
    {
        assert!(ended.out.contains(word), "no {word:?} in {}", ended.out);
    }
    let page = std::str::from_utf8(&content["index.html"]).unwrap();
    for line in &lines {
        let recording = line["recording"].as_str().unwrap().replace('/', "&#x2f;");
        assert!(page.contains(&recording), "{recording}");
        let calibration = line["calibration"].as_str();
        assert!(calibration.is_none_or(|file| page.contains(&format!("href=\"{file}\""))));
    }
    assert!(desk.file("whole/batch.json").is_file());
}

#[test]
fn shards_give_the_bytes_of_one_run() {
    let Whole { desk, content: whole, .. } = &*WHOLE;
    let output = "shards";
    let first = batch(desk, output, &["--shard", "1/2", "--threads", "3"]);
    assert_done(&first);
    assert!(first.out.contains("still to be done"), "{}", first.out);
    eyebolt(&["batch", "--merge", text(&desk.file(output))])
        .assert_error(1, &["lines", "in/", "and 2 more", "every shard"]);
    assert_done(&batch(desk, output, &["--shard", "0/2"]));
    assert_same(&desk.file(output), whole);
    fs::remove_file(desk.file("shards/batch.jsonl")).unwrap();
    let merged = eyebolt(&["batch", "--merge", text(&desk.file(output))]);
    assert_done(&merged);
    assert!(merged.out.contains("trusted               2"), "{}", merged.out);
    assert_same(&desk.file(output), whole);
}

/// What is done is not done again: its files are those that were there.
#[test]
fn a_part_of_a_folder_becomes_the_whole() {
    let Whole { desk, content: whole, .. } = &*WHOLE;
    let folder = desk.file("part");
    assert_done(&batch(desk, "part", &["--shard", "0/2"]));
    let before: BTreeMap<String, _> = content(&folder)
        .into_keys()
        .filter(|name| name.starts_with("lines/"))
        .map(|name| (name.clone(), fs::metadata(folder.join(name)).unwrap().modified().unwrap()))
        .collect();
    assert_eq!(before.len(), 3);
    let ended = batch(desk, "part", &["--json"]);
    assert_done(&ended);
    assert_eq!(ended.out.as_bytes(), whole["batch.jsonl"]);
    for (name, modified) in before {
        assert_eq!(
            fs::metadata(folder.join(&name)).unwrap().modified().unwrap(),
            modified,
            "{name}"
        );
    }
    assert_same(&folder, whole);
    // A calibration that somebody removed is made again.
    let lost = whole.keys().find(|name| name.starts_with("good-")).unwrap();
    fs::remove_file(folder.join(lost)).unwrap();
    assert_done(&batch(desk, "part", &[]));
    assert_same(&folder, whole);
}

#[test]
fn killed_after_each_line_nothing_is_lost() {
    let Whole { desk, content: whole, .. } = &*WHOLE;
    let folder = desk.file("killed");
    let done = || {
        fs::read_dir(folder.join("lines")).map_or(0, |lines| {
            lines
                .flatten()
                .filter(|line| line.path().extension().is_some_and(|it| it == "json"))
                .count()
        })
    };
    for _ in 0..3 {
        let before = done();
        let mut run = Command::new(env!("CARGO_BIN_EXE_eyebolt"));
        run.args(["batch", "--list", "list.txt", "-o", "killed", "--cache", text(&CACHE)]);
        run.current_dir(desk.path()).stdout(Stdio::null()).stderr(Stdio::null());
        let mut run = run.spawn().unwrap();
        while done() == before && run.try_wait().unwrap().is_none() {
            thread::yield_now();
        }
        let _ = run.kill();
        run.wait().unwrap();
        assert!(done() > before);
    }
    assert_done(&batch(desk, "killed", &[]));
    assert_same(&folder, whole);
}

#[test]
fn what_failed_is_tried_again_if_asked_for() {
    let desk = Desk::new();
    let recording = desk.file("later");
    let run = |more: &[&str]| {
        let fixed = ["batch", text(&recording), "-o", "out", "--json", "--cache", text(&CACHE)];
        let ended = eyebolt_in(desk.path(), &[&fixed, more].concat());
        assert_done(&ended);
        lines(&ended.out)[0]["ending"].as_str().unwrap().to_owned()
    };
    assert_eq!(run(&[]), "failed");
    std::os::unix::fs::symlink(&*RECORDING, &recording).unwrap();
    assert_eq!(run(&[]), "failed");
    assert_eq!(run(&["--retry"]), "trusted");
    assert_eq!(run(&["--retry"]), "trusted");
}

#[test]
fn what_cannot_be_is_told_before_any_work() {
    let desk = Desk::new();
    let refused = |more: &[&str], words: &[&str]| {
        eyebolt_in(desk.path(), &[&["batch"], more].concat()).assert_error(1, words);
    };
    fs::write(desk.file("empty.txt"), "# none\n").unwrap();
    refused(&["--list", "empty.txt", "-o", "out"], &["empty.txt", "--list", "each line"]);
    refused(&["--list", "nowhere.txt", "-o", "out"], &["nowhere.txt", "--list"]);
    refused(&["a", "-o", "out", "--robot", "nobody"], &["--robot nobody"]);
    refused(&["a", "-o", "out", "--model", "nowhere"], &["nowhere", "eyebolt train"]);
    refused(&["a", "-o", "."], &["--output", "other things"]);
    refused(&["--merge", "."], &["batch.json", "Name the folder"]);
    assert_eq!(desk.names(), ["empty.txt"]);
    let begun = eyebolt_in(desk.path(), &["batch", "a", "-o", "out"]);
    assert_done(&begun);
    refused(&["a", "-o", "out", "--seed", "2"], &["batch.json", "--seed was 1, and is 2 now"]);
    refused(&["a", "-o", "out", "--report"], &["--report was not given"]);
    eyebolt(&["batch", "-o", "out"]).assert_error(2, &["RECORDINGS"]);
    eyebolt(&["batch", "a", "-o", "out", "--shard", "2/2"]).assert_error(2, &["1/2"]);
}
