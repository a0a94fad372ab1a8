//! What is said to newcomers, and to other programs.

use crate::desk::{Desk, text};
use crate::good::GOOD;
use crate::program::{RECORDING, calibrate, eyebolt};
use crate::recording::write_depth;
use crate::scene::shots;
use serde_json::Value;
use std::fs;
use std::path::Path;

#[test]
fn it_goes_by_its_own_name() {
    let said = eyebolt(&["--version"]).out;
    assert_eq!(said, format!("eyebolt {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn the_line_to_record_with_is_todays() {
    let ended = eyebolt(&["record-command"]);
    let expected = "ros2 bag record -s mcap -o my_bag --topics /camera/camera/depth/image_rect_raw \
                    /camera/camera/depth/camera_info /joint_states /robot_description /tf_static\n";
    assert_eq!((ended.code, ended.out.as_str()), (Some(0), expected));
    let own = eyebolt(&["record-command", "--depth-topic", "/eye/depth", "--humble"]).out;
    assert!(own.contains(" my_bag /eye/depth /eye/camera_info ") && !own.contains("--topics"));
    // What is written and the program say the same.
    let written =
        [include_str!("../../../../README.md"), include_str!("../../../../docs/recordings.md")];
    for page in written {
        assert!(page.replace("\\\n        ", "").contains(expected.trim_end()));
    }
}

#[test]
fn a_folder_without_a_description_gets_one() {
    let desk = Desk::new();
    write_depth(desk.path(), &shots());
    let described = fs::read_to_string(desk.file("recording.toml")).unwrap();
    fs::remove_file(desk.file("recording.toml")).unwrap();
    eyebolt(&["info", text(desk.path())]).assert_error(1, &["eyebolt init", "recording.toml"]);
    let ended = eyebolt(&["init", text(desk.path())]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    for words in ["depth_unit is a guess", "then: eyebolt info"] {
        assert!(ended.out.contains(words), "no {words:?} in: {}", ended.out);
    }
    let made = fs::read_to_string(desk.file("recording.toml")).unwrap();
    for key in ["info", "depth", "joints", "joint_names", "mask", "depth_unit", "urdf"] {
        let line = |text: &str| {
            let value = text.lines().find_map(|line| line.strip_prefix(&format!("{key} = ")));
            value.map(str::to_owned)
        };
        assert_eq!(line(&made), line(&described), "{key}");
    }
    assert_eq!(eyebolt(&["info", text(desk.path())]).code, Some(0));
    eyebolt(&["init", text(desk.path())]).assert_error(1, &["recording.toml", "there already"]);
}

#[test]
fn a_refusal_says_what_to_do() {
    let desk = Desk::new();
    let out = desk.calibrate_stranger(&[]).out;
    for words in ["REFUSED", "does not fit the robot", "robot that was recorded: --robot"] {
        assert!(out.contains(words), "no {words:?} in: {out}");
    }
    assert!(!out.contains("\x1b["), "colours are for terminals: {out}");
}

#[test]
fn the_expected_error_says_where_it_holds() {
    let out = &GOOD.ended.out;
    let answer: Value = serde_json::from_str(&GOOD.json).unwrap();
    let camera = answer["camera_position_error_mm"].as_f64().unwrap();
    assert!(out.contains("expected error, workspace"), "{out}");
    let line = out.lines().find(|line| line.contains("the camera's own position")).unwrap();
    assert!(line.ends_with(&format!("{camera:.1} mm")), "{line}");
    assert!(camera > 0.0);
}

#[test]
fn a_dash_is_standard_output() {
    let ended = calibrate(&RECORDING, Path::new("-"), &[]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(ended.out == GOOD.json && ended.err.starts_with("TRUSTED"), "{}", ended.err);
    let json = GOOD.desk.file("calibration.json");
    let exported =
        |more: &[&str]| eyebolt(&[&["export", text(&json), "--as", "csv"], more].concat()).out;
    assert_eq!(exported(&["-o", "-"]), exported(&[]));
    assert!(!Path::new("-").exists());
}

#[test]
fn names_of_files_say_what_is_in_them() {
    let desk = Desk::new();
    let ended = calibrate(&RECORDING, &desk.file("camera.yaml"), &[]);
    ended.assert_error(1, &["camera.yaml", "--output", "ends in .json", "eyebolt export"]);
    let page = desk.file("page.pdf");
    let ended = desk.calibrate(&["--report", text(&page)]);
    ended.assert_error(1, &["page.pdf", "--report", "ends in .html"]);
    let bag = desk.file("session.bag");
    let ended = eyebolt(&["simulate", "-o", text(&bag)]);
    ended.assert_error(1, &["session.bag", "--output", "ends in .mcap"]);
    assert!(desk.names().is_empty());
}

#[test]
fn names_of_exports_say_what_is_in_them() {
    let json = GOOD.desk.file("calibration.json");
    let desk = Desk::new();
    for (format, name, words) in [
        ("csv", "camera.yaml", "Give .csv for it, or give --as easy-handeye2 or --as easy-handeye"),
        ("easy-handeye", "camera.json", "end in .yaml. Give .yaml for it"),
        ("ros2-launch", "camera.launch", "Give .py for it, or give --as moveit-ros1"),
        ("npy", "camera.csv", "Give .npy for it, or give --as csv"),
    ] {
        let file = desk.file(name);
        let ended = eyebolt(&["export", text(&json), "--as", format, "-o", text(&file)]);
        ended.assert_error(1, &[name, "--output", words]);
    }
    assert!(desk.names().is_empty());
    for (format, name) in [("csv", "camera"), ("easy-handeye", "camera.YML"), ("tf2", "tf.sh")] {
        let file = desk.file(name);
        let ended = eyebolt(&["export", text(&json), "--as", format, "-o", text(&file)]);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
    }
}
