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

/// As `ros2 topic echo` prints it.
const TF_STATIC: &str = "transforms:
- header:
    stamp:
      sec: 0
      nanosec: 0
    frame_id: camera_link
  child_frame_id: depth_optical
  transform:
    translation:
      x: 0.1
      y: 0.0
      z: 0.0
    rotation:
      x: -0.5
      y: 0.5
      z: -0.5
      w: 0.5
---
";

#[test]
fn a_file_of_static_transforms_is_checked() {
    let sample = Sample::depth();
    let described = std::fs::read_to_string(sample.file("recording.toml")).unwrap();
    let info = "info = \"camera_info.yaml\"";
    let named = format!("{info}\ntf_static = \"tf.yaml\"");
    sample.write("recording.toml", described.replace(info, &named).as_bytes());
    let open = || Folder::open(sample.path());
    assert_says(open(), &["tf.yaml", "cannot read camera.tf_static"]);
    for (text, words) in [
        ("", "there are none"),
        ("transforms: []", "there are none"),
        ("hello: 1", "transforms: the field is missing"),
        (&TF_STATIC.replace("child_frame_id", "child"), "transforms[0].child_frame_id"),
        (&TF_STATIC.replace("x: 0.1", "x: far"), "transforms: "),
    ] {
        sample.write("tf.yaml", text.as_bytes());
        assert_says(open(), &["tf.yaml", words, "ros2 topic echo"]);
    }
    sample.write("tf.yaml", TF_STATIC.as_bytes());
    assert_eq!(open().unwrap().static_transforms().len(), 1);
}

#[test]
fn what_lies_there_is_described_and_read() {
    let sample = Sample::depth();
    sample.remove("recording.toml");
    sample.write("arm.urdf", b"<robot name=\"arm\"/>");
    sample.write("tf_static.yaml", TF_STATIC.as_bytes());
    let described = describe_folder(sample.path(), &joints).unwrap();
    sample.write("recording.toml", described.toml.as_bytes());
    let folder = Folder::open(sample.path()).unwrap();
    assert_eq!(folder.frame_names(), ["2", "10"]);
    let frame = folder.read_frame(0).unwrap();
    assert!(frame.mask.is_some() && folder.read_color(0).unwrap().is_some());
    assert_eq!(frame.joints.get("elbow"), Some(-1.5));
    assert_eq!(folder.robot().urdf.as_deref(), Some(sample.file("arm.urdf").as_path()));
    let around = folder.static_transforms();
    assert_eq!((around.len(), around[0].child.as_str()), (1, "depth_optical"));
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
