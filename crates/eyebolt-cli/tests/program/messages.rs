//! What the program says to someone who made a mistake.

use crate::desk::Desk;
use crate::program::{RECORDING, calibrate, eyebolt};
use crate::recording::{write, write_depth};
use crate::scene::{JOINTS, shot};
use eyebolt::calibrate::Limits;
use serde_json::Value;
use std::fs;
use std::path::Path;

#[test]
fn help_tells_units_and_exit_status() {
    let help = eyebolt(&["calibrate", "--help"]);
    assert_eq!((help.code, help.err.as_str()), (Some(0), ""));
    for word in ["millimetres", "degrees", "recording.toml", "<MM>", "<DEG>", "calibration.json"] {
        assert!(help.out.contains(word), "no {word:?} in: {}", help.out);
    }
    let Limits { expected, .. } = Limits::default();
    let (mm, deg) = (1e3 * expected.translation_m, expected.rotation_rad.to_degrees());
    assert!(help.out.contains(&format!("millimetres [default: {mm}]")), "{}", help.out);
    assert!(help.out.contains(&format!("degrees [default: {deg:.1}]")), "{}", help.out);
    let help = eyebolt(&["--help"]);
    assert!(help.out.contains("0 trusted") && help.out.contains("3 refused"), "{}", help.out);
}

#[test]
fn wrong_usage_ends_with_2() {
    let cases: [(&[&str], &str); 6] = [
        (&[], "Usage"),
        (&["calibrate"], "<RECORDING>"),
        (&["calibrate", "r", "--nonsense"], "--nonsense"),
        (&["calibrate", "r", "--threads", "0"], "--threads"),
        (&["calibrate", "r", "--max-error-mm", "-1"], "-1"),
        (&["calibrate", "r", "--max-error-deg", "nan"], "above 0"),
    ];
    for (arguments, word) in cases {
        eyebolt(arguments).assert_error(2, &[word]);
    }
}

#[test]
fn a_missing_recording_is_named() {
    let desk = Desk::new();
    let ended = calibrate(Path::new("no/such/place"), &desk.file("c.json"), &[]);
    ended.assert_error(1, &["no/such/place", "recording"]);
    let empty = desk.file("empty");
    fs::create_dir(&empty).unwrap();
    let ended = calibrate(&empty, &desk.file("c.json"), &[]);
    ended.assert_error(1, &["empty", "the folder is empty", "a folder with a recording.toml"]);
    assert_eq!(desk.names(), ["empty"]);
}

#[test]
fn a_missing_robot_is_named() {
    let desk = Desk::new();
    desk.calibrate(&["--robot", "no/arm.urdf"]).assert_error(1, &["no/arm.urdf", "URDF", "path"]);
    write_depth(desk.path(), &[shot(JOINTS[0], 1)]);
    let toml = desk.file("recording.toml");
    let described = fs::read_to_string(&toml).unwrap();
    fs::write(&toml, described.replace("urdf = \"arm.urdf\"\n", "")).unwrap();
    for recording in [desk.path(), &toml] {
        let ended = calibrate(recording, &desk.file("c.json"), &[]);
        ended.assert_error(1, &["recording.toml: robot.urdf", "--robot arm.urdf"]);
    }
}

#[test]
fn an_unknown_link_is_answered_with_those_there_are() {
    let desk = Desk::new();
    let ended = desk.calibrate(&["--base", "nosuch"]);
    ended.assert_error(1, &["`nosuch`", "--base", "shoulder", "upper_arm", "hand"]);
    let ended = desk.calibrate(&["--end-effector", "nosuch"]);
    ended.assert_error(1, &["`nosuch`", "--end-effector", "shoulder", "upper_arm", "hand"]);
    assert!(desk.names().is_empty());
}

#[test]
fn another_robot_is_refused_with_the_reason_in_the_file() {
    let desk = Desk::new();
    let ended = desk.calibrate_stranger(&[]);
    assert_eq!((ended.code, ended.err.as_str()), (Some(3), ""));
    let rejected = fs::read_to_string(desk.file("calibration.rejected.json")).unwrap();
    let rejected: Value = serde_json::from_str(&rejected).unwrap();
    assert_eq!(rejected["camera_from_base"], Value::Null, "identity is never a fallback");
    let reason = rejected["reasons"][0].as_str().unwrap();
    for word in ["stranger", "neck", "elbow", "joint names"] {
        assert!(reason.contains(word), "no {word:?} in: {reason}");
    }
    assert!(ended.out.contains(reason), "{}", ended.out);
    assert!(!ended.out.contains("of 0 frames"), "{}", ended.out);
    assert_eq!(desk.names(), ["calibration.rejected.json"]);
}

#[test]
fn a_damaged_file_is_named_with_its_field_and_a_remedy() {
    let desk = Desk::new();
    write_depth(desk.path(), &[shot(JOINTS[0], 1)]);
    let output = desk.file("c.json");
    let complains = |words: &[&str]| calibrate(desk.path(), &output, &[]).assert_error(1, words);
    let whole = fs::read(desk.file("depth_0.npy")).unwrap();
    write(desk.path(), "depth_0.npy", &whole[..whole.len() / 2]);
    complains(&["depth_0.npy", "depth"]);
    write(desk.path(), "depth_0.npy", &whole);
    fs::remove_file(desk.file("joints_0.npy")).unwrap();
    complains(&["recording.toml", "frames.joints", "joints_0.npy", "is missing"]);
    let toml = fs::read_to_string(RECORDING.join("recording.toml")).unwrap();
    let in_cm = toml.replace("depth_unit = \"m\"", "depth_unit = \"cm\"");
    write(desk.path(), "recording.toml", in_cm.as_bytes());
    complains(&["recording.toml", "depth_unit", "\"cm\"", "mm"]);
    assert!(!output.exists() && !desk.file("c.rejected.json").exists());
}

#[test]
fn one_error_is_one_line() {
    let desk = Desk::new();
    let ended = calibrate(Path::new("no/such/place"), &desk.file("c.json"), &[]);
    assert!(ended.err.starts_with("error: ") && ended.err.lines().count() == 1, "{}", ended.err);
}
