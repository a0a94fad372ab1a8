//! `eyebolt evaluate`: simulated recordings have an answer.

use crate::desk::{Desk, text};
use crate::program::{Ended, RECORDING, calibrate, eyebolt};
use crate::simulate::SIMULATED;
use serde_json::Value;
use std::fs;
use std::path::Path;

fn evaluate(session: &Path, calibration: &Path, more: &[&str]) -> Ended {
    let mut arguments = vec!["evaluate", text(session), text(calibration)];
    arguments.extend(more);
    eyebolt(&arguments)
}

#[test]
fn simulate_calibrate_evaluate() {
    let desk = Desk::new();
    let calibration = desk.file("calibration.json");
    let ended = calibrate(&SIMULATED, &calibration, &[]);
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
    let ended = evaluate(&SIMULATED, &calibration, &["--json"]);
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""));
    assert_eq!(ended.out.lines().count(), 1, "{}", ended.out);
    let line: Value = serde_json::from_str(&ended.out).unwrap();
    let names: Vec<&String> = line.as_object().unwrap().keys().collect();
    assert_eq!(names, ["camera_position_mm", "rotation_deg", "translation_mm", "trusted"]);
    assert!(line["translation_mm"].as_f64().unwrap() < 2.0, "{line}");
    assert!(line["rotation_deg"].as_f64().unwrap() < 0.15, "{line}");
    assert_eq!(line["trusted"], true);
    let ended = evaluate(&SIMULATED, &calibration, &[]);
    let mm = format!("{:.2} mm", line["translation_mm"].as_f64().unwrap());
    assert!(ended.out.starts_with("trusted: ") && ended.out.contains(&mm), "{}", ended.out);
}

#[test]
fn a_refused_calibration_is_evaluated_and_said_to_be_refused() {
    let desk = Desk::new();
    let ended = calibrate(&SIMULATED, &desk.file("c.json"), &["--max-error-mm", "0.001"]);
    assert_eq!(ended.code, Some(3), "{}", ended.err);
    let rejected = desk.file("c.rejected.json");
    let ended = evaluate(&SIMULATED, &rejected, &[]);
    assert!(ended.code == Some(0) && ended.out.starts_with("REFUSED: "), "{}", ended.out);
    let line: Value =
        serde_json::from_str(&evaluate(&SIMULATED, &rejected, &["--json"]).out).unwrap();
    assert_eq!(line["trusted"], false);
}

#[test]
fn without_a_pose_there_is_nothing_to_compare() {
    let desk = Desk::new();
    assert_eq!(desk.calibrate_stranger(&[]).code, Some(3));
    let rejected = desk.file("calibration.rejected.json");
    // Of another robot, whose base is another link.
    let words = ["calibration.rejected.json: frames.base", "\"link0\"", "--base link0"];
    evaluate(&SIMULATED, &rejected, &[]).assert_error(1, &words);
    let mut answer: Value = serde_json::from_slice(&fs::read(&rejected).unwrap()).unwrap();
    answer["frames"]["base"] = "link0".into();
    fs::write(&rejected, answer.to_string()).unwrap();
    let ended = evaluate(&SIMULATED, &rejected, &[]);
    assert!(ended.code == Some(0) && ended.out.starts_with("REFUSED: no pose"), "{}", ended.out);
    let line: Value =
        serde_json::from_str(&evaluate(&SIMULATED, &rejected, &["--json"]).out).unwrap();
    assert_eq!((&line["translation_mm"], &line["trusted"]), (&Value::Null, &false.into()));
}

#[test]
fn a_recording_without_truth_is_told_apart() {
    let desk = Desk::new();
    let calibration = desk.file("c.json");
    fs::write(&calibration, "{}").unwrap();
    let words = ["truth", "eyebolt simulate"];
    evaluate(&RECORDING, &calibration, &[]).assert_error(1, &words);
    evaluate(Path::new("no/such"), &calibration, &[]).assert_error(1, &["no/such"]);
    let ended = evaluate(&SIMULATED, &calibration, &[]);
    ended.assert_error(1, &["c.json"]);
    let ended = evaluate(&SIMULATED, &desk.file("missing.json"), &[]);
    ended.assert_error(1, &["missing.json"]);
}

/// The truth goes along where the recording goes.
#[test]
fn the_truth_is_found_in_a_converted_recording_and_by_itself() {
    let desk = Desk::new();
    let folder = desk.file("folder");
    assert_eq!(eyebolt(&["convert", text(&SIMULATED), text(&folder)]).code, Some(0));
    assert!(folder.join("truth.json").exists());
    let calibration = desk.file("c.json");
    let ended = calibrate(&folder, &calibration, &[]);
    assert_eq!(ended.code, Some(0), "{}{}", ended.out, ended.err);
    let by_folder = evaluate(&folder, &calibration, &["--json"]);
    let by_file = evaluate(&folder.join("truth.json"), &calibration, &["--json"]);
    assert_eq!((by_folder.code, by_folder.err.as_str()), (Some(0), ""));
    assert_eq!(by_folder.out, by_file.out);
    assert_eq!(by_folder.out, evaluate(&SIMULATED, &calibration, &["--json"]).out);
}

#[test]
fn after_a_bump_both_poses_are_compared() {
    let desk = Desk::new();
    let (session, calibration) = (desk.file("bumped.mcap"), desk.file("c.json"));
    let few = ["--configurations", "4", "--frames", "1", "--backgrounds", "0", "--clutter", "0"];
    let bump = ["--bump", "100,0", "--preset", "paper-test-p1"];
    let ended = crate::simulate::simulate(&session, &[&few[..], &bump].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let _ = calibrate(&session, &calibration, &[]);
    let rejected = desk.file("c.rejected.json");
    assert!(rejected.exists(), "100 mm in the middle of a recording are not to be trusted");
    let ended = evaluate(&session, &rejected, &["--json"]);
    let line: Value = serde_json::from_str(&ended.out).unwrap();
    let after = line["after_bump"].as_array().unwrap();
    assert_eq!(after.len(), 1);
    let mm = |line: &Value| line["translation_mm"].as_f64().unwrap();
    assert!(mm(&line) + mm(&after[0]) > 99.0, "the two are 100 mm apart: {line}");
    assert!(evaluate(&session, &rejected, &[]).out.contains("bumped"));
}
