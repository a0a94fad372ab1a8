//! Every mistake in a truth is told with its file, field and remedy.

use crate::sample::{Desk, assert_says, truth};
use eyebolt_recording::read_truth;
use serde_json::{Value, json};
use std::fs;

#[track_caller]
fn said_of(text: &str, parts: &[&str]) {
    let desk = Desk::new();
    let file = desk.file("truth.json");
    fs::write(&file, text).unwrap();
    let parts: Vec<_> =
        parts.iter().chain(&["truth.json: ", "eyebolt simulate"]).copied().collect();
    assert_says(read_truth(&file), &parts);
}

/// The right truth with the value at `pointer` replaced.
#[track_caller]
fn replaced(pointer: &str, value: Value, parts: &[&str]) {
    let mut root: Value = serde_json::from_str(&truth().to_json()).unwrap();
    *root.pointer_mut(pointer).unwrap() = value;
    said_of(&root.to_string(), parts);
}

#[test]
fn fields_must_be_there() {
    for field in ["schema", "robot", "base", "sensor", "seed", "camera_from_base"] {
        let mut root: Value = serde_json::from_str(&truth().to_json()).unwrap();
        root.as_object_mut().unwrap().remove(field).unwrap();
        said_of(&root.to_string(), &[&format!("truth.json: {field}: the field is missing")]);
    }
    said_of("{}", &["schema: the field is missing"]);
}

#[test]
fn fields_are_of_their_kind() {
    replaced("/schema", json!("eyebolt.truth/2"), &["schema: \"eyebolt.truth/2\" is not"]);
    replaced("/robot", json!(3), &["robot: it is no text"]);
    replaced("/base", json!(3), &["base: it is no text"]);
    replaced("/preset", json!(3), &["preset: it is no text"]);
    for seed in [json!(-1), json!(0.5), json!("1"), json!(1e30)] {
        replaced("/seed", seed, &["seed: ", "no whole number"]);
    }
    replaced("/faults", json!([1]), &["faults: it is no object"]);
    replaced("/camera_from_base_after", json!({}), &["camera_from_base_after: it is no list"]);
    replaced(
        "/camera_from_base_after/0",
        json!(1),
        &["camera_from_base_after[0]: it is no object"],
    );
    let field = "camera_from_base_after[0].stamp_ns: it is no whole number";
    replaced("/camera_from_base_after/0/stamp_ns", json!(0.5), &[field]);
}

#[test]
fn matrices_are_finite_of_4x4_and_rigid() {
    // What serde, and Python for "not a number" by hand, write.
    replaced("/camera_from_base/1/2", Value::Null, &["camera_from_base[1][2]: it is no finite"]);
    replaced("/camera_from_base/0/0", json!("1"), &["camera_from_base[0][0]: it is no finite"]);
    replaced("/camera_from_base/2", json!([0, 0, 1]), &["camera_from_base[2]: it is no list of 4"]);
    replaced("/camera_from_base", json!([[1]]), &["camera_from_base: it is no list of 4"]);
    replaced("/camera_from_base", json!("eye"), &["camera_from_base: it is no list of 4"]);
    let rigid = "camera_from_base: the matrix is no rigid transform";
    replaced("/camera_from_base/3", json!([0, 0, 1, 1]), &[rigid]);
    replaced("/camera_from_base/0/0", json!(1.0), &[rigid]);
    let mirror = json!([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]]);
    replaced("/camera_from_base", mirror.clone(), &[rigid]);
    let scaled = json!([[1.001, 0, 0, 0], [0, 1.001, 0, 0], [0, 0, 1.001, 0], [0, 0, 0, 1]]);
    replaced("/camera_from_base", scaled, &[rigid]);
    let later = "/camera_from_base_after/0/camera_from_base";
    replaced(
        later,
        mirror,
        &["camera_from_base_after[0].camera_from_base: the matrix is no rigid"],
    );
}

#[test]
fn a_camera_moves_in_order_of_time() {
    let root: Value = serde_json::from_str(&truth().to_json()).unwrap();
    let moved = &root["camera_from_base_after"][0];
    let twice = json!([moved, moved]);
    let field = "camera_from_base_after[1].stamp_ns: it is not later than the one before";
    replaced("/camera_from_base_after", twice, &[field]);
}

#[test]
fn text_is_json() {
    let right = truth().to_json();
    // As Python writes it.
    said_of(
        &right.replacen("\"seed\": ", "\"seed\": NaN, \"s\": ", 1),
        &["line 7, column", "no NaN"],
    );
    said_of(&right.replacen("[", "[1e999, ", 1), &["line ", "out of range"]);
    said_of(&right[..right.len() / 2], &["EOF while parsing"]);
    said_of("", &["EOF while parsing"]);
    said_of("[]", &["expected a map"]);
    said_of(&"[".repeat(100_000), &["truth.json"]);
    let desk = Desk::new();
    let file = desk.file("truth.json");
    fs::write(&file, b"{\"schema\": \"\xff\"}").unwrap();
    assert_says(read_truth(&file), &["truth.json", "byte 12 is not UTF-8"]);
    fs::write(&file, vec![b' '; (1 << 20) + 1]).unwrap();
    assert_says(read_truth(&file), &["truth.json", "larger than 1 MiB"]);
}
