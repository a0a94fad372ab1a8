//! `eyebolt calibrate --marker`, on what `eyebolt simulate --marker` wrote.

use crate::desk::{Desk, text};
use crate::program::{calibrate, eyebolt};
use crate::simulate::{SIMULATED, simulate};
use serde_json::Value;
use std::fs;

#[test]
fn simulate_calibrate_evaluate_with_a_marker() {
    let desk = Desk::new();
    let session = desk.file("session.mcap");
    let marker = "aruco:4x4_50:0.08";
    let quick = ["--configurations", "12", "--frames", "2", "--backgrounds", "0", "--clutter", "0"];
    let ended = simulate(&session, &[&quick[..], &["--marker", marker]].concat());
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""));
    assert!(ended.out.contains("--marker aruco:4x4_50:0.08"), "{}", ended.out);
    let calibration = desk.file("calibration.json");
    let ended = calibrate(&session, &calibration, &["--marker", marker]);
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
    for words in
        ["TRUSTED by aruco:4x4_50:0.08:0", "tsai_lenz", "by the arm's own shape from there on"]
    {
        assert!(ended.out.contains(words), "no {words:?} in: {}", ended.out);
    }
    let answer: Value = serde_json::from_slice(&fs::read(&calibration).unwrap()).unwrap();
    assert_eq!(answer["arrangement"], "eye_to_hand");
    assert_eq!(answer["marker"]["solvers"].as_object().unwrap().len(), 4);
    assert!(answer["markerless"]["difference"]["translation_mm"].as_f64().unwrap() < 15.0);
    let ended = eyebolt(&["evaluate", text(&session), text(&calibration), "--json"]);
    let line: Value = serde_json::from_str(&ended.out).unwrap();
    assert!(line["translation_mm"].as_f64().unwrap() < 5.0, "{line}");
    let ended = eyebolt(&["export", text(&calibration), "--as", "tf2"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
}

#[test]
fn markers_that_are_none_are_answered_with_how_to_write_one() {
    let desk = Desk::new();
    let calibration = desk.file("calibration.json");
    for (marker, words) in [
        ("aruco", ["write aruco:", "charuco:"]),
        ("aruco:4x4:0.05", ["no dictionary", "4x4_50"]),
        ("aruco:4x4_50:5cm", ["metres", "5cm"]),
    ] {
        calibrate(&SIMULATED, &calibration, &["--marker", marker]).assert_error(2, &words);
    }
    calibrate(&SIMULATED, &calibration, &["--eye-in-hand"]).assert_error(2, &["--marker"]);
    let ended = calibrate(&SIMULATED, &calibration, &["--marker", "aruco:4x4_50:0.05"]);
    ended.assert_error(1, &["session.mcap", "no colour pictures"]);
    assert!(desk.names().is_empty());
}
