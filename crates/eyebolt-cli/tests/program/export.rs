//! `eyebolt export`, on the calibration of the shared run.

use crate::desk::{Desk, text};
use crate::good::{GOOD, parsed};
use crate::program::{Ended, eyebolt};
use eyebolt_recording::{StaticTransform, write_static_transforms};
use nalgebra::Matrix4;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

const FORMATS: [&str; 11] = [
    "tf2",
    "tf2-ros1",
    "ros2-launch",
    "easy-handeye2",
    "easy-handeye",
    "moveit",
    "moveit-ros1",
    "urdf",
    "csv",
    "npy",
    "mcap",
];

/// What a driver says of a camera whose depth optical frame is the shared run's.
const DRIVER: &str = r#"{"transforms": [
  {"header": {"frame_id": "camera_link"}, "child_frame_id": "depth_optical",
   "transform": {"translation": {"x": 0.01, "y": 0.02, "z": 0.03},
                 "rotation": {"x": -0.5, "y": 0.5, "z": -0.5, "w": 0.5}}}]}"#;

fn calibration() -> std::path::PathBuf {
    assert_eq!(GOOD.ended.code, Some(0), "{}", GOOD.ended.err);
    GOOD.desk.file("calibration.json")
}

/// Runs `eyebolt export` on `calibration`.
fn export(calibration: &Path, format: &str, more: &[&str]) -> Ended {
    let mut arguments = vec!["export", text(calibration), "--as", format];
    arguments.extend(more);
    eyebolt(&arguments)
}

/// A file in the desk with what `change` made of the shared calibration.
fn changed(desk: &Desk, change: impl Fn(&mut Value)) -> std::path::PathBuf {
    let mut json = parsed();
    change(&mut json);
    let path = desk.file("changed.json");
    fs::write(&path, json.to_string()).unwrap();
    path
}

fn base_from_camera() -> Matrix4<f64> {
    let rows = parsed()["base_from_camera"]["matrix"].clone();
    let rows: [[f64; 4]; 4] = serde_json::from_value(rows).unwrap();
    Matrix4::from_row_slice(rows.as_flattened())
}

fn matrix(csv: &str) -> Matrix4<f64> {
    Matrix4::from_row_iterator(csv.trim().split([',', '\n']).map(|n| n.parse().unwrap()))
}

#[test]
fn every_format_goes_to_a_file_and_to_standard_output() {
    let desk = Desk::new();
    for format in FORMATS {
        let file = desk.file(format);
        // The recording told nothing of the optical frame's parent, which matters to who publishes it.
        let note = |err: &str| match format {
            "csv" | "npy" => err.is_empty(),
            _ => {
                err.starts_with("note: the recording has no /tf_static") && err.lines().count() == 1
            }
        };
        let ended = export(&calibration(), format, &["--output", text(&file)]);
        assert!(ended.code == Some(0) && note(&ended.err), "{format}: {}", ended.err);
        let said = format!("pose of depth_optical in base, written to {}\n", text(&file));
        assert_eq!(ended.out, said);
        if !matches!(format, "npy" | "mcap") && !format.starts_with("easy") {
            let ended = export(&calibration(), format, &[]);
            assert!(ended.code == Some(0) && note(&ended.err), "{format}: {}", ended.err);
            assert_eq!(ended.out.as_bytes(), fs::read(&file).unwrap(), "{format}");
        }
    }
    assert_eq!(desk.names().len(), FORMATS.len());
}

#[test]
fn what_is_exported_is_base_from_camera() {
    let ended = export(&calibration(), "csv", &[]);
    assert!((matrix(&ended.out) - base_from_camera()).amax() < 1e-12);
    let tf2 = export(&calibration(), "tf2", &[]).out;
    let words: Vec<_> = tf2.lines().last().unwrap().split(' ').collect();
    let value = |option: &str| words[words.iter().position(|word| *word == option).unwrap() + 1];
    assert_eq!((value("--frame-id"), value("--child-frame-id")), ("base", "depth_optical"));
    let translation_m = ["--x", "--y", "--z"].map(|option| value(option).parse::<f64>().unwrap());
    let expected = base_from_camera();
    for (row, metres) in translation_m.into_iter().enumerate() {
        assert!((metres - expected[(row, 3)]).abs() < 1e-12);
    }
}

#[test]
fn numpys_matrix_needs_a_file() {
    export(&calibration(), "npy", &[]).assert_error(2, &["--output"]);
    let desk = Desk::new();
    let file = desk.file("base_from_camera.npy");
    assert_eq!(export(&calibration(), "npy", &["-o", text(&file)]).code, Some(0));
    let bytes = fs::read(&file).unwrap();
    let numbers = bytes[bytes.len() - 128..].chunks_exact(8);
    let numbers = numbers.map(|number| f64::from_le_bytes(number.try_into().unwrap()));
    assert!((Matrix4::from_row_iterator(numbers) - base_from_camera()).amax() < 1e-12);
}

#[test]
fn hand_eye_files_are_called_like_their_file() {
    let desk = Desk::new();
    let file = desk.file("cell_3.calib");
    assert_eq!(export(&calibration(), "easy-handeye2", &["-o", text(&file)]).code, Some(0));
    assert!(fs::read_to_string(&file).unwrap().contains("name: \"cell_3\""));
    assert!(export(&calibration(), "easy-handeye2", &[]).out.contains("name: \"eyebolt\""));
}

#[test]
fn a_file_that_is_there_stays_unless_forced() {
    let desk = Desk::new();
    let file = desk.file("camera.launch.py");
    fs::write(&file, "precious").unwrap();
    let ended = export(&calibration(), "moveit", &["-o", text(&file)]);
    ended.assert_error(1, &["camera.launch.py", "exists", "--force"]);
    assert_eq!(fs::read(&file).unwrap(), b"precious");
    let ended = export(&calibration(), "moveit", &["-o", text(&file), "--force"]);
    assert_eq!((ended.code, desk.names().len()), (Some(0), 1));
    assert!(fs::read_to_string(&file).unwrap().contains("static_transform_publisher"));
}

#[test]
fn a_drivers_frames_move_the_child_to_their_root() {
    let desk = Desk::new();
    let tree = desk.file("tf.json");
    fs::write(&tree, DRIVER).unwrap();
    let ended = export(&calibration(), "csv", &["--camera-tree", text(&tree)]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    for words in ["note: depth_optical has the parent camera_link", "pose of camera_link"] {
        assert!(ended.err.contains(words), "{}", ended.err);
    }
    // The body's axes x, y, z are the optical z, -x, -y.
    #[rustfmt::skip]
    let link_from_optical = Matrix4::new(
        0.0, 0.0, 1.0, 0.01,
        -1.0, 0.0, 0.0, 0.02,
        0.0, -1.0, 0.0, 0.03,
        0.0, 0.0, 0.0, 1.0,
    );
    assert!((matrix(&ended.out) * link_from_optical - base_from_camera()).amax() < 1e-12);
    // The same by name, and the other way round.
    let more =
        ["--camera-tree", text(&tree), "--base-frame", "camera_link", "--camera-frame", "base"];
    let back = export(&calibration(), "csv", &more);
    assert_eq!(back.err, "");
    assert!((matrix(&back.out) * matrix(&ended.out) - Matrix4::identity()).amax() < 1e-12);
}

#[test]
fn a_urdf_leads_above_the_base() {
    let desk = Desk::new();
    let urdf = desk.file("cell.urdf");
    let cell = r#"<robot name="cell"><link name="world"/><link name="base"/>
        <joint name="feet" type="fixed"><parent link="world"/><child link="base"/>
        <origin xyz="0 0 0.75"/></joint></robot>"#;
    fs::write(&urdf, cell).unwrap();
    let more = ["--camera-tree", text(&urdf), "--parent-frame", "world"];
    let ended = export(&calibration(), "csv", &more);
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""));
    let raised = Matrix4::new_translation(&nalgebra::Vector3::new(0.0, 0.0, 0.75));
    assert!((matrix(&ended.out) - raised * base_from_camera()).amax() < 1e-12);
}

#[test]
fn unknown_frames_are_answered_with_those_there_are() {
    let ended = export(&calibration(), "tf2", &["--camera-frame", "camera_link"]);
    ended.assert_error(1, &["camera_link", "base, depth_optical", "--camera-tree"]);
    let ended = export(&calibration(), "tf2", &["--child-frame", "a\nb"]);
    ended.assert_error(1, &["\"a\\nb\"", "line break"]);
}

#[test]
fn a_camera_without_a_name_is_asked_for_one() {
    let desk = Desk::new();
    let unnamed = changed(&desk, |json| json["frames"]["camera"] = Value::Null);
    let ended = export(&unnamed, "tf2", &[]);
    ended.assert_error(1, &["changed.json: frames.camera", "--optical-frame"]);
    for flag in ["--camera-frame", "--optical-frame"] {
        let ended = export(&unnamed, "tf2", &[flag, "eye"]);
        assert!(ended.out.ends_with("--frame-id base --child-frame-id eye\n"), "{}", ended.out);
    }
}

#[test]
fn a_refused_calibration_is_not_exported_by_mistake() {
    let desk = Desk::new();
    let refused = changed(&desk, |json| {
        json["verdict"] = json!("refused");
        json["reasons"] = json!(["a rival pose"]);
    });
    let ended = export(&refused, "tf2", &[]);
    ended.assert_error(1, &["changed.json: verdict", "a rival pose", "--even-if-refused"]);
    let ended = export(&refused, "tf2", &["--even-if-refused"]);
    assert_eq!(ended.code, Some(0));
    assert!(ended.err.starts_with("note: ") && ended.err.contains("a rival pose"), "{}", ended.err);
    // What the program itself refuses has no pose at all.
    assert_eq!(desk.calibrate_stranger(&[]).code, Some(3));
    let rejected = desk.file("calibration.rejected.json");
    export(&rejected, "tf2", &["--even-if-refused"]).assert_error(1, &["rejected.json", "no pose"]);
}

#[test]
fn what_is_no_calibration_is_named() {
    export(Path::new("no/such.json"), "tf2", &[]).assert_error(1, &["no/such.json", "exists"]);
    let desk = Desk::new();
    let file = desk.file("tf.json");
    fs::write(&file, DRIVER).unwrap();
    export(&file, "tf2", &[]).assert_error(1, &["tf.json: schema", "eyebolt calibrate"]);
    let tree = ["--camera-tree", "no/tf.yaml"];
    export(&calibration(), "tf2", &tree).assert_error(1, &["no/tf.yaml", "exists"]);
    let itself = calibration();
    let ended = export(&itself, "tf2", &["--camera-tree", text(&itself)]);
    ended.assert_error(1, &["calibration.json: transforms", "ros2 topic echo"]);
}

#[test]
fn wrong_usage_ends_with_2() {
    eyebolt(&["export"]).assert_error(2, &["<CALIBRATION.JSON>", "--as"]);
    export(Path::new("c.json"), "rviz", &[]).assert_error(2, &["rviz", "tf2", "moveit-ros1"]);
}

#[test]
fn help_tells_direction_frames_and_formats() {
    let help = eyebolt(&["export", "--help"]);
    assert_eq!((help.code, help.err.as_str()), (Some(0), ""));
    for words in FORMATS.into_iter().chain([
        "base_from_camera, not camera_from_base",
        "OPTICAL frame: x right, y down, z forward",
        "x forward, y left, z up",
        "/tf_static",
        "second one",
        "Rz(yaw) Ry(pitch) Rx(roll)",
    ]) {
        assert!(help.out.contains(words), "no {words:?} in: {}", help.out);
    }
}

#[test]
fn a_bag_tells_the_cameras_frames_too() {
    let desk = Desk::new();
    let (json, bag, other) = (desk.file("tf.json"), desk.file("tf.mcap"), desk.file("other.mcap"));
    fs::write(&json, DRIVER).unwrap();
    let transform = StaticTransform {
        parent: "camera_link".to_owned(),
        child: "depth_optical".to_owned(),
        translation_m: [0.01, 0.02, 0.03],
        rotation_xyzw: [-0.5, 0.5, -0.5, 0.5],
    };
    write_static_transforms(&[transform], 0, fs::File::create(&bag).unwrap()).unwrap();
    let placed = |tree: &Path| export(&calibration(), "csv", &["--camera-tree", text(tree)]);
    let (from_json, from_bag) = (placed(&json), placed(&bag));
    assert_eq!((from_bag.code, &from_bag.out), (Some(0), &from_json.out), "{}", from_bag.err);
    assert!((matrix(&from_bag.out) - base_from_camera()).amax() > 0.1, "the root is placed");
    // An earlier calibration in it would contradict this one; a bag without the topic tells nothing.
    assert_eq!(export(&calibration(), "mcap", &["-o", text(&other)]).code, Some(0));
    let ended = placed(&other);
    ended.assert_error(1, &["other.mcap", "base", "depth_optical"]);
    write_static_transforms(&[], 0, fs::File::create(&bag).unwrap()).unwrap();
    placed(&bag).assert_error(1, &["tf.mcap", "/tf_static", "no transforms"]);
}
