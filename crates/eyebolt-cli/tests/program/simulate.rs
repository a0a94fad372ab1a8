//! `eyebolt simulate`: what it writes, and where it will not.

use crate::desk::{Desk, fresh, text};
use crate::program::{CACHE, Ended, eyebolt};
use eyebolt_recording::{BagOptions, Recording, read_truth};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// A simulated recording, shared by all tests.
pub static SIMULATED: LazyLock<PathBuf> = LazyLock::new(|| {
    let path = fresh("program-simulated").join("session.mcap");
    let quick = ["--configurations", "5", "--frames", "3", "--backgrounds", "3", "--clutter", "3"];
    let ended = simulate(&path, &[&quick[..], &["--preset", "paper-test-p1"]].concat());
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
    for line in ["5 x 3 frames", "kinect-v1", "eyebolt evaluate", text(&path)] {
        assert!(ended.out.contains(line), "no {line:?} in: {}", ended.out);
    }
    path
});

/// Runs `eyebolt simulate` into `output`.
pub fn simulate(output: &Path, more: &[&str]) -> Ended {
    let mut arguments = vec!["simulate", "--output", text(output), "--cache", text(&CACHE)];
    arguments.extend(more);
    eyebolt(&arguments)
}

/// As little as there can be.
const LITTLE: [&str; 12] = [
    "--configurations",
    "1",
    "--frames",
    "1",
    "--backgrounds",
    "0",
    "--clutter",
    "0",
    "--sensor",
    "ideal",
    "--preset",
    "paper-train-p2",
];

#[test]
fn it_is_an_ordinary_recording_that_info_finds_ready() {
    let ended = eyebolt(&["info", text(&SIMULATED), "--json"]);
    let info: serde_json::Value = serde_json::from_str(&ended.out).unwrap();
    assert_eq!(info["advice"].as_array().unwrap().len(), 0, "{info}");
    assert_eq!((&info["frames"]["used"], &info["robot"]["base"]), (&15.into(), &"link0".into()));
    assert_eq!(info["configurations"].as_array().unwrap().len(), 5);
}

#[test]
fn the_bytes_are_those_of_the_seed() {
    let desk = Desk::new();
    let run = |name: &str, more: &[&str]| {
        let path = desk.file(name);
        let ended = simulate(&path, &[&LITTLE[..], more].concat());
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        fs::read(path).unwrap()
    };
    let first = run("a.mcap", &["--seed", "5", "--threads", "1"]);
    assert!(run("b.mcap", &["--seed", "5", "--threads", "2"]) == first);
    assert!(run("c.mcap", &["--seed", "6"]) != first);
}

#[test]
fn flags_arrive_where_they_should() {
    let desk = Desk::new();
    let path = desk.file("a.mcap");
    let faults = ["--depth-scale", "1.02", "--depth-offset-mm", "-5", "--focal-scale", "0.99"];
    let more = ["--centre-px", "-2,3", "--joint-offset-deg", "0.5", "--backlash-deg", "0.25"];
    let last = ["--time-skew-ms", "-20", "--bump", "10,2", "--seed", "9", "--frames", "2"];
    let camera = ["--distance-m", "1.1", "--azimuth-deg", "-30,-20", "--elevation-deg", "30"];
    let few = ["--configurations", "2", "--backgrounds", "2", "--clutter", "0"];
    let all = [&faults[..], &more, &last, &camera, &few, &["--sensor", "azure-kinect"]].concat();
    let ended = simulate(&path, &all);
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
    let truth = read_truth(&path).unwrap();
    let expected = serde_json::json!({
        "depth_scale": 1.02, "depth_offset_mm": -5.0, "focal_scale": 0.99, "centre_x_px": -2.0,
        "centre_y_px": 3.0, "joint_offset_deg": 0.5, "backlash_deg": 0.25, "time_skew_ms": -20.0,
        "bump_mm": 10.0, "bump_deg": 2.0,
    });
    for (name, value) in expected.as_object().unwrap() {
        let off = truth.faults[name].as_f64().unwrap() - value.as_f64().unwrap();
        assert!(off.abs() < 1e-9, "{name}: {off}");
    }
    assert_eq!((truth.sensor.as_str(), truth.preset, truth.seed), ("azure-kinect", None, 9));
    assert_eq!((truth.faults.len(), truth.camera_from_base_after.len()), (10, 1));
    let recording = Recording::open(&path, &BagOptions::default()).unwrap();
    assert_eq!((recording.frame_names().len(), recording.background_count()), (4, 2));
    // 30 degrees above what it looks at, 1.1 m away, on the side of negative y.
    let eye = truth.camera_from_base.inverse().translation_m();
    assert!((0.85..0.93).contains(&eye.z) && (-0.49..-0.31).contains(&eye.y), "{eye}");
}

#[test]
fn flags_of_the_laboratory_arrive_where_they_should() {
    let desk = Desk::new();
    let path = desk.file("a.mcap");
    let parts = ["--tool-mm", "100", "--cable", "--cover", "--second-arm", "still", "--far-room"];
    let depth = ["--gloss", "0.2", "--wander-mm", "5", "--fixed-pattern", "1"];
    let room = ["--passers-by", "1", "--other-rooms", "0.5", "--occlusion", "0.1"];
    let arm = ["--one-joint-offset-deg", "1", "--link-length-mm", "4", "--wrist-only"];
    let ended = simulate(&path, &[&LITTLE[..], &parts, &depth, &room, &arm].concat());
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
    let truth = read_truth(&path).unwrap();
    let expected = serde_json::json!({
        "tool_mm": 100.0, "cable": 1.0, "cover": 1.0, "second_arm_still": 1.0, "far_room": 1.0,
        "gloss": 0.2, "wander_mm": 5.0, "fixed_pattern": 1.0, "passers_by": 1.0, "other_rooms": 0.5,
        "occlusion": 0.1, "one_joint_offset_deg": 1.0, "link_length_mm": 4.0, "wrist_only": 1.0,
    });
    assert_eq!(truth.faults.len(), expected.as_object().unwrap().len(), "{:?}", truth.faults);
    for (name, value) in expected.as_object().unwrap() {
        let off = truth.faults[name].as_f64().unwrap() - value.as_f64().unwrap();
        assert!(off.abs() < 1e-9, "{name}: {off}");
    }
}

#[test]
fn an_existing_file_stays_unless_forced() {
    let desk = Desk::new();
    let path = desk.file("a.mcap");
    fs::write(&path, "precious").unwrap();
    simulate(&path, &LITTLE).assert_error(1, &["a.mcap", "exists", "--force"]);
    assert_eq!(fs::read(&path).unwrap(), b"precious");
    let ended = simulate(&path, &[&LITTLE[..], &["--force"]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(read_truth(&path).is_ok());
    let folder = desk.file("folder");
    fs::create_dir(&folder).unwrap();
    simulate(&folder, &[&LITTLE[..], &["--force"]].concat()).assert_error(1, &["folder"]);
    assert_eq!(desk.names(), ["a.mcap", "folder"]);
}

#[test]
fn another_robot_is_simulated_from_its_urdf() {
    let root = std::env::var_os("EYEBOLT_SHARED").map(PathBuf::from);
    let urdf = root.map(|root| root.join("data/robots/panda/panda_hand.urdf"));
    let Some(urdf) = urdf.filter(|urdf| urdf.is_file()) else {
        let remedy = "set EYEBOLT_SHARED to the folder of shared data";
        let _ = writeln!(std::io::stderr(), "SKIPPED a simulation of the Panda: {remedy}");
        return;
    };
    let desk = Desk::new();
    let path = desk.file("panda.mcap");
    let ended = simulate(&path, &[&LITTLE[..], &["--robot", text(&urdf)]].concat());
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""));
    assert_eq!(read_truth(&path).unwrap().robot, "panda");
    let recording = Recording::open(&path, &BagOptions::default()).unwrap();
    assert_eq!(recording.robot().description, Some(fs::read_to_string(&urdf).unwrap()));
    assert!(recording.read_joints(0).unwrap().get("panda_joint7").is_some());
}
