//! `eyebolt demo`: all of it, with nothing needed.

use crate::desk::{Desk, text};
use crate::program::{CACHE, eyebolt, eyebolt_in};
use std::fs;
use std::io::Write;

#[test]
fn it_takes_the_next_free_name_and_says_what_it_made() {
    let desk = Desk::new();
    fs::create_dir(desk.file("eyebolt-demo")).unwrap();
    fs::write(desk.file("eyebolt-demo/mine.txt"), "").unwrap();
    let ended = eyebolt_in(desk.path(), &["demo", "--cache", text(&CACHE)]);
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
    assert_eq!(desk.names(), ["eyebolt-demo", "eyebolt-demo-2"]);
    assert_eq!(fs::read_dir(desk.file("eyebolt-demo")).unwrap().count(), 1);
    let made = desk.file("eyebolt-demo-2");
    let mut names: Vec<_> = fs::read_dir(&made)
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names, ["calibration.json", "report.html", "session.mcap"]);
    for said in [
        "TRUSTED",
        "eyebolt-demo-2/session.mcap",
        "eyebolt-demo-2/report.html",
        "eyebolt-demo-2/calibration.json",
        "against where the camera really was",
        "ros2 bag record",
    ] {
        assert!(ended.out.contains(said), "no {said:?} in: {}", ended.out);
    }
    let page = fs::read_to_string(made.join("report.html")).unwrap();
    assert!(page.starts_with("<!DOCTYPE html>") && page.contains("Trusted"));
    // What it says of itself is what `evaluate` says of its files.
    let session = made.join("session.mcap");
    let calibration = made.join("calibration.json");
    let line = eyebolt(&["evaluate", text(&session), text(&calibration), "--json"]).out;
    let line: serde_json::Value = serde_json::from_str(&line).unwrap();
    let number = |name: &str| line[name].as_f64().unwrap();
    let off =
        format!("{:.2} mm and {:.3} degrees", number("translation_mm"), number("rotation_deg"));
    assert!(ended.out.contains(&off), "{off} not in: {}", ended.out);
    assert!(number("translation_mm") < 2.0 && number("rotation_deg") < 0.15, "{line}");
    // The optical frame has a parent on the recording's /tf_static: the root above it is placed.
    let exported = eyebolt(&["export", text(&calibration), "--as", "tf2"]);
    let words = "--frame-id link0 --child-frame-id camera_link";
    assert!(exported.out.contains(words), "{}{}", exported.out, exported.err);
    assert!(page.contains("--child-frame-id camera_link"));
}

#[test]
fn what_is_there_stays() {
    let desk = Desk::new();
    let file = desk.file("notes");
    fs::write(&file, "precious").unwrap();
    for there in [desk.path(), &file] {
        let ended = eyebolt(&["demo", "--output", text(there)]);
        ended.assert_error(1, &[text(there), "already", "new folder"]);
    }
    assert_eq!(fs::read(&file).unwrap(), b"precious");
    // Below a file there is no room for a folder.
    let below = file.join("demo");
    let ended = eyebolt(&["demo", "--output", text(&below), "--cache", text(&CACHE)]);
    ended.assert_error(1, &[text(&below), "cannot"]);
    assert_eq!(desk.names(), ["notes"]);
}

#[test]
fn bad_flags_are_wrong_usage() {
    for flags in [
        ["--sensor", "eye"],
        ["--seed", "one"],
        ["--joint-offset-deg", "nan"],
        ["--joint-offset-deg", "-1"],
        ["--joint-offset-deg", "1e9"],
        ["--threads", "0"],
    ] {
        let desk = Desk::new();
        let ended = eyebolt_in(desk.path(), &["demo", flags[0], flags[1]]);
        ended.assert_error(2, &[flags[0]]);
        assert!(desk.names().is_empty());
    }
}

#[cfg(unix)]
#[test]
fn a_folder_that_is_read_only_is_named() {
    use std::os::unix::fs::PermissionsExt;
    let desk = Desk::new();
    let locked = desk.file("locked");
    fs::create_dir(&locked).unwrap();
    fs::set_permissions(&locked, fs::Permissions::from_mode(0o555)).unwrap();
    if fs::write(locked.join("probe"), "").is_ok() {
        let _ = writeln!(std::io::stderr(), "SKIPPED: no folder is read-only to this user");
        return;
    }
    let ended = eyebolt_in(&locked, &["demo", "--cache", text(&CACHE)]);
    ended.assert_error(1, &["eyebolt-demo", "cannot write"]);
}
