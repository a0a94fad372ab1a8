//! `eyebolt calibrate --model`, and `eyebolt evaluate --model`.

use crate::desk::{Desk, text};
use crate::program::{CACHE, Ended, RECORDING, calibrate, eyebolt};
use crate::simulate::SIMULATED;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// How far a calibration of the simulated recording is off, millimetres and degrees.
fn off(calibration: &Path) -> (f64, f64) {
    let ended = eyebolt(&["evaluate", text(&SIMULATED), text(calibration), "--json"]);
    let line: Value = serde_json::from_str(&ended.out).unwrap();
    (line["translation_mm"].as_f64().unwrap(), line["rotation_deg"].as_f64().unwrap())
}

/// With the arm's own networks and with those of any arm, with the same bytes on any number of threads.
#[test]
fn with_a_model_a_calibration_is_as_good_as_from_nothing() {
    let desk = Desk::new();
    for name in ["shackle", "any-arm"] {
        let path = desk.file(&format!("{name}.json"));
        let ended = calibrate(&SIMULATED, &path, &["--model", name, "--threads", "1"]);
        assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
        let (mm, deg) = off(&path);
        assert!(mm < 2.0 && deg < 0.15, "{name}: {mm} mm, {deg} deg");
        let again = desk.file("again.json");
        calibrate(&SIMULATED, &again, &["--model", name, "--threads", "2", "--force"]);
        assert!(fs::read(&again).unwrap() == fs::read(&path).unwrap(), "{name}");
    }
}

/// Centimetres off, it says so; true labels bring it nearer.
#[test]
fn the_papers_way_knows_how_far_it_is_off() {
    let desk = Desk::new();
    for more in [&["--no-icp"][..], &["--labels", "true"]] {
        let path = desk.file("paper.json");
        let more = [&["--model", "shackle", "--method", "paper", "--force"], more].concat();
        let ended = calibrate(&SIMULATED, &path, &more);
        assert_eq!(ended.code, Some(3), "{}", ended.err);
        let rejected = desk.file("paper.rejected.json");
        let (mm, deg) = off(&rejected);
        assert!(mm < 60.0 && deg < 8.0, "{more:?}: {mm} mm, {deg} deg");
        let json: Value = serde_json::from_slice(&fs::read(&rejected).unwrap()).unwrap();
        assert!(json["expected_error"]["translation_mm"].as_f64().unwrap() > 0.2 * mm, "{json}");
    }
}

#[test]
fn what_a_method_lacks_is_named() {
    let desk = Desk::new();
    let path = desk.file("c.json");
    let refused = |recording: &Path, more: &[&str], words: &[&str]| {
        calibrate(recording, &path, more).assert_error(1, words);
        assert!(desk.names().is_empty());
    };
    refused(&SIMULATED, &["--method", "paper"], &["--method paper", "--model"]);
    let paper = ["--method", "paper", "--model", "any-arm"];
    refused(&SIMULATED, &paper, &["any-arm", "end-effector", "eyebolt train"]);
    let of_truth = ["--method", "paper", "--labels", "true", "--model", "shackle"];
    refused(&RECORDING, &of_truth, &["truth"]);
    refused(
        &SIMULATED,
        &["--model", "nowhere"],
        &["nowhere", "any-arm, panda, shackle", "eyebolt train"],
    );
}

fn evaluate(more: &[&str]) -> Ended {
    let named = "ours=shackle";
    let fixed = ["evaluate", text(&SIMULATED), "--model", named, "--cache", text(&CACHE)];
    eyebolt(&[&fixed, more].concat())
}

#[test]
fn a_model_has_the_tables_of_the_paper() {
    let desk = Desk::new();
    let (csv, page) = (desk.file("t.csv"), desk.file("t.html"));
    let ended = evaluate(&["--json", "--csv", text(&csv), "--report", text(&page)]);
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
    let tables: Value = serde_json::from_str(&ended.out).unwrap();
    let titles: Vec<&str> =
        tables.as_array().unwrap().iter().map(|table| table["title"].as_str().unwrap()).collect();
    assert_eq!(titles.len(), 4, "{titles:?}");
    let cell =
        |table: usize, row: usize, column: usize| &tables[table]["rows"][row]["cells"][column];
    // The fused pose by true labels: fifteen frames, most of them answered, none beyond a centimetre.
    let count = |column: usize| cell(1, 4, column)["value"].as_f64().unwrap();
    assert!(count(3) == 15.0 && count(4) >= 13.0 && count(5) == 0.0, "{}", tables[1]);
    assert!(count(2) < 3.0, "{}", tables[1]);
    assert_eq!(cell(1, 0, 0)["paper"], 23.6);
    assert!(cell(3, 3, 0)["value"].as_f64().unwrap() < 2.0, "{}", tables[3]);
    let lines = fs::read_to_string(&csv).unwrap();
    assert!(lines.starts_with("table,row,column,value,deviation,paper\n"));
    assert!(lines.contains("\"fused\",\"ADD mm\","), "{lines}");
    let page = fs::read_to_string(&page).unwrap();
    assert!(
        page.starts_with("<!DOCTYPE html>")
            && page.contains("KPM + ICP")
            && page.contains("(24.90)")
    );
    evaluate(&["--csv", text(&csv)]).assert_error(1, &["t.csv", "--force"]);
}

#[test]
fn paths_that_are_not_a_recording_and_its_calibration_are_told_what_belongs_there() {
    eyebolt(&["evaluate", text(&SIMULATED)]).assert_error(1, &["one path", "--model"]);
    let file = SIMULATED.as_path();
    eyebolt(&["evaluate", text(file), text(file), text(file)])
        .assert_error(1, &["3 paths", "--model"]);
    evaluate(&["--calibration", "a.json", "--calibration", "b.json"])
        .assert_error(1, &["--calibration", "2 for 1 recordings"]);
}
