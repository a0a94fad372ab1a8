//! `eyebolt pose`, by the networks that come with the program.

use crate::desk::{Desk, text};
use crate::program::{CACHE, Ended, eyebolt};
use crate::simulate::SIMULATED;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

fn models(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models").join(name)
}

fn pose(more: &[&str]) -> Ended {
    let model = models("shackle");
    let fixed = ["pose", text(&SIMULATED), "--model", text(&model), "--cache", text(&CACHE)];
    eyebolt(&[&fixed, more].concat())
}

#[test]
fn every_frame_has_its_line_and_no_answer_is_far_off() {
    let desk = Desk::new();
    let file = desk.file("poses.jsonl");
    let ended = pose(&["--json", "-o", text(&file)]);
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
    assert_eq!(fs::read_to_string(&file).unwrap(), ended.out);
    let lines: Vec<Value> =
        ended.out.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines.len(), 15);
    let answered: Vec<&Value> = lines.iter().filter(|line| line["answered"] == true).collect();
    assert!(answered.len() >= 10, "{}", ended.out);
    for line in &answered {
        assert_eq!((&line["method"], &line["reason"]), (&"fused".into(), &Value::Null));
        assert!(line["expected_error"]["translation_mm"].as_f64().unwrap() > 0.0);
        let z = line["camera_from_end_effector"]["translation_m"][2].as_f64().unwrap();
        assert!((0.3..3.0).contains(&z), "{line}");
    }
    // Frames of one configuration, three each, agree.
    for three in lines.chunks(3) {
        let at = |line: &Value, axis: usize| {
            line["camera_from_end_effector"]["translation_m"][axis].as_f64().unwrap()
        };
        let both = three.iter().filter(|line| line["answered"] == true).collect::<Vec<_>>();
        for pair in both.windows(2) {
            let off = (0..3).map(|axis| (at(pair[0], axis) - at(pair[1], axis)).powi(2));
            assert!(off.sum::<f64>().sqrt() < 0.02, "{pair:?}");
        }
    }
    pose(&["-o", text(&file)]).assert_error(1, &["poses.jsonl", "exists", "--force"]);
}

#[test]
fn as_the_networks_have_it_no_error_is_expected() {
    let ended = pose(&["--json", "--method", "rpt", "--no-icp"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    for line in ended.out.lines() {
        let line: Value = serde_json::from_str(line).unwrap();
        assert_eq!((&line["method"], &line["expected_error"]), (&"rpt".into(), &Value::Null));
    }
}

#[test]
fn models_of_something_else_are_refused() {
    let refused = |model: &Path, words: &[&str]| {
        eyebolt(&["pose", text(&SIMULATED), "--model", text(model)]).assert_error(1, words);
    };
    refused(&models("any-arm"), &["any-arm", "end-effector", "eyebolt train"]);
    refused(Path::new("nowhere"), &["nowhere", "eyebolt train"]);
}
