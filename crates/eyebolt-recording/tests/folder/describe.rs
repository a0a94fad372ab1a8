//! A `recording.toml` from what lies in a folder.

use crate::sample::{HEIGHT, Sample, WIDTH, assert_says, npy_f64, npy_u16};
use eyebolt_recording::{Folder, FrameSource, describe_folder};
use std::path::Path;

fn joints(_: &Path) -> Vec<String> {
    vec!["shoulder".to_owned(), "elbow".to_owned()]
}

fn nobody(_: &Path) -> Vec<String> {
    Vec::new()
}

#[test]
fn what_lies_there_is_described_and_read() {
    let sample = Sample::depth();
    sample.remove("recording.toml");
    sample.write("arm.urdf", b"<robot name=\"arm\"/>");
    let described = describe_folder(sample.path(), &joints).unwrap();
    sample.write("recording.toml", described.toml.as_bytes());
    let folder = Folder::open(sample.path()).unwrap();
    assert_eq!(folder.frame_names(), ["2", "10"]);
    let frame = folder.read_frame(0).unwrap();
    assert!(frame.mask.is_some() && folder.read_color(0).unwrap().is_some());
    assert_eq!(frame.joints.get("elbow"), Some(-1.5));
    assert_eq!(folder.robot().urdf.as_deref(), Some(sample.file("arm.urdf").as_path()));
    // Guesses are said to be such.
    let checks = described.to_check.join("\n");
    for words in ["depth_unit is a guess: \"m\"", "1.25 m", "joint_names"] {
        assert!(checks.contains(words), "no {words:?} in: {checks}");
    }
    assert_says(describe_folder(sample.path(), &joints), &["recording.toml", "there already"]);
}

#[test]
fn integers_are_taken_for_millimetres_unless_the_camera_says_otherwise() {
    let sample = Sample::depth();
    sample.remove("recording.toml");
    for name in ["2", "10"] {
        let depth = npy_u16(&[HEIGHT, WIDTH], &[1500; HEIGHT * WIDTH]);
        sample.write(&format!("depth_{name}.npy"), &depth);
    }
    let toml = || describe_folder(sample.path(), &joints).unwrap().toml;
    assert!(toml().contains("depth_unit = \"mm\""), "{}", toml());
    sample.remove("camera_info.yaml");
    let bop = r#"{"cx": 1.5, "cy": 1.0, "depth_scale": 0.1, "fx": 5.0, "fy": 6.0, "height": 3,
                  "width": 4}"#;
    sample.write("camera.json", bop.as_bytes());
    assert!(toml().contains("info = \"camera.json\"") && toml().contains("depth_unit = 0.0001"));
}

#[test]
fn what_is_missing_is_said() {
    let sample = Sample::depth();
    for file in ["recording.toml", "camera_info.yaml"] {
        sample.remove(file);
    }
    let checks = describe_folder(sample.path(), &nobody).unwrap().to_check.join("\n");
    for words in ["no intrinsics", "list the 2 joints", "no robot description"] {
        assert!(checks.contains(words), "no {words:?} in: {checks}");
    }
    let empty = tempfile::tempdir().unwrap();
    assert_says(describe_folder(empty.path(), &nobody), &["no series of depth images"]);
    std::fs::write(empty.path().join("joints_0.npy"), npy_f64(&[2], &[0.0; 2])).unwrap();
    assert_says(describe_folder(empty.path(), &nobody), &["no series of depth images"]);
    assert_says(describe_folder(&empty.path().join("none"), &nobody), &["none", "cannot read"]);
}

#[test]
fn what_is_no_recording_is_called_what_it_is() {
    use eyebolt_recording::{BagOptions, Recording};
    let sample = Sample::depth();
    let open = |name: &str| Recording::open(&sample.file(name), &BagOptions::default());
    sample.write("arm.urdf", b"<?xml version=\"1.0\"?><robot name=\"a\"/>");
    sample.write("calibration.json", br#"{"schema": "eyebolt.calibration/1"}"#);
    sample.write("metadata.yaml", b"rosbag2_bagfile_information:\n  version: 5\n");
    sample.write("empty.mcap", b"");
    for (name, words) in [
        ("nothing_here", ["no such file or folder", "Check its name"]),
        ("depth_2.npy", ["one image or array", "recording.toml"]),
        ("color_2.png", ["one image or array", "recording.toml"]),
        ("camera_info.yaml", ["intrinsics of a camera", "`camera_info`"]),
        ("arm.urdf", ["a robot description", "`robot`"]),
        ("calibration.json", ["a calibration", "made from"]),
        ("metadata.yaml", ["the metadata of a bag", "Give its folder"]),
        ("empty.mcap", ["an empty file", "Record again"]),
    ] {
        assert_says(open(name), &words);
    }
    // A folder of recordings, one or two of them.
    let above = tempfile::tempdir().unwrap();
    let open = || Recording::open(above.path(), &BagOptions::default());
    assert_says(open(), &["the folder is empty"]);
    for (count, words) in
        [(1, ["in a folder below", "Give "]), (2, ["2 recordings", "Give one of"])]
    {
        let below = above.path().join(format!("session_{count}"));
        std::fs::create_dir(&below).unwrap();
        std::fs::write(below.join("recording.toml"), "").unwrap();
        assert_says(open(), &words);
    }
}
