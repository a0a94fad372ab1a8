//! `eyebolt info`: what it finds in a recording, and what it advises.

use crate::desk::{Desk, text};
use crate::program::{RECORDING, eyebolt};
use crate::recording::write_depth;
use crate::scene::{JOINTS, shot};
use serde_json::Value;
use std::fs;
use std::path::Path;

fn json(recording: &Path, more: &[&str]) -> Value {
    let mut arguments = vec!["info", text(recording), "--json"];
    arguments.extend(more);
    let ended = eyebolt(&arguments);
    let info: Value = serde_json::from_str(&ended.out).unwrap();
    let code = if info["ready"].as_bool().unwrap() { 0 } else { 3 };
    assert_eq!((ended.code, ended.err.as_str()), (Some(code), ""));
    info
}

/// Whether one of the pieces of advice has all of `words`.
fn advises(info: &Value, words: &[&str]) -> bool {
    let advice = info["advice"].as_array().unwrap();
    advice.iter().any(|line| words.iter().all(|word| line.as_str().unwrap().contains(word)))
}

#[test]
fn a_good_recording_is_ready() {
    let info = json(&RECORDING, &[]);
    assert_eq!(info["advice"].as_array().unwrap().len(), 0, "{info}");
    assert_eq!((&info["schema"], &info["ready"]), (&"eyebolt.info/1".into(), &true.into()));
    assert_eq!((&info["kind"], &info["frames"]["used"]), (&"folder".into(), &5.into()));
    assert_eq!(info["configurations"].as_array().unwrap().len(), 5);
    assert_eq!(info["robot"]["base"], "base");
    assert!(info["depth"]["share_valid"].as_f64().unwrap() > 0.3);
    let ended = eyebolt(&["info", text(&RECORDING)]);
    for line in ["configurations  5", "with masks", "ready to calibrate"] {
        assert!(ended.out.contains(line), "no {line:?} in: {}", ended.out);
    }
}

#[test]
fn another_robots_joints_are_named() {
    let urdf = RECORDING.join("other.urdf");
    let info = json(&RECORDING, &["--robot", text(&urdf)]);
    assert_eq!(info["robot"]["missing_joints"], serde_json::json!(["neck"]));
    assert_eq!(info["robot"]["unknown_joints"].as_array().unwrap().len(), 6);
    assert!(
        advises(&info, &["joint neck of the arm is not recorded: record its states"]),
        "{info}"
    );
    assert_eq!(info["ready"], false);
}

#[test]
fn few_configurations_are_said_to_be_few() {
    let desk = Desk::new();
    // Twice the same, and another: frames are grouped by their joints, not by their order.
    let shots = [shot(JOINTS[0], 1), shot(JOINTS[1], 2), shot(JOINTS[0], 3)];
    write_depth(desk.path(), &shots);
    let info = json(desk.path(), &[]);
    let frames: Vec<_> =
        info["configurations"].as_array().unwrap().iter().map(|c| c["frames"].clone()).collect();
    assert_eq!(frames, [2, 1]);
    assert!(advises(&info, &["2 arm configurations are too few", "at least 3"]), "{info}");
    assert_eq!(info["ready"], false);
    let ended = eyebolt(&["info", text(desk.path())]);
    assert!(ended.out.contains("not ready to calibrate") && ended.code == Some(3));
}

#[test]
fn joints_outside_their_limits_are_named() {
    let desk = Desk::new();
    write_depth(desk.path(), &[shot(JOINTS[0], 1)]);
    let urdf = fs::read_to_string(desk.file("arm.urdf")).unwrap();
    let narrow = with_narrow_limits(&urdf);
    fs::write(desk.file("arm.urdf"), narrow).unwrap();
    let info = json(desk.path(), &[]);
    assert!(!info["robot"]["outside_limits"].as_array().unwrap().is_empty(), "{info}");
    assert!(advises(&info, &["outside its limits", "in frame 0"]), "{info}");
}

/// The URDF with limits that no position of the recording meets.
fn with_narrow_limits(urdf: &str) -> String {
    let parts: Vec<&str> = urdf.split("<limit ").collect();
    let narrow = |part: &&str| {
        let rest = part.split_once("/>").unwrap().1;
        format!("<limit lower=\"3.0\" upper=\"3.1\" effort=\"1\" velocity=\"1\"/>{rest}")
    };
    let limits: String = parts[1..].iter().map(narrow).collect();
    format!("{}{limits}", parts[0])
}

#[test]
fn a_recording_without_a_robot_can_be_looked_at() {
    let desk = Desk::new();
    write_depth(desk.path(), &[shot(JOINTS[0], 1)]);
    let toml = fs::read_to_string(desk.file("recording.toml")).unwrap();
    fs::write(desk.file("recording.toml"), toml.split("[robot]").next().unwrap()).unwrap();
    let info = json(desk.path(), &[]);
    assert_eq!(info["robot"], Value::Null);
    assert!(advises(&info, &["no robot is known", "--robot"]), "{info}");
}

#[test]
fn what_is_no_recording_is_an_error() {
    eyebolt(&["info", "no/such/place"])
        .assert_error(1, &["no/such/place", "no such file or folder"]);
}

#[test]
fn a_robot_without_its_meshes_is_a_piece_of_advice() {
    let desk = Desk::new();
    write_depth(desk.path(), &[shot(JOINTS[0], 1)]);
    let urdf = fs::read_to_string(desk.file("arm.urdf")).unwrap();
    let mesh =
        "<visual><geometry><mesh filename=\"package://none/a.stl\"/></geometry></visual></link>";
    fs::write(desk.file("arm.urdf"), urdf.replacen("</link>", mesh, 1)).unwrap();
    let info = json(desk.path(), &[]);
    assert_eq!((&info["robot"], &info["frames"]["used"]), (&Value::Null, &1.into()));
    assert!(advises(&info, &["robot description cannot be used", "a.stl", "--package-path"]));
    assert!(!advises(&info, &["no robot is known"]));
}
