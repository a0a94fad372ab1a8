//! The forms in which ROS writes a camera.

use crate::sample::{CAMERA_INFO, Sample, assert_says};
use eyebolt_geometry::Distortion;
use eyebolt_recording::{CameraInfo, FrameSource, RecordingError};

fn read(text: &str) -> Result<CameraInfo, RecordingError> {
    let sample = Sample::depth();
    sample.write("camera_info.yaml", text.as_bytes());
    CameraInfo::read(&sample.file("camera_info.yaml"))
}

const MESSAGE: &str = "header:
  stamp:
    sec: 12
    nanosec: 5
  frame_id: optical
height: 3
width: 4
distortion_model: rational_polynomial
d:
- 1.0
- 2.0
- 3.0
- 4.0
- 5.0
- 6.0
- 7.0
- 8.0
k: [5.0, 0.0, 1.5, 0.0, 6, 1.0, 0.0, 0.0, 1.0]
r: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
binning_x: 0
---
";

const CALIBRATION: &str = "image_width: 4
image_height: 3
camera_name: narrow
camera_matrix:
  rows: 3
  cols: 3
  data: [5., 0., 1.5, 0., 6., 1., 0., 0., 1.]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [1, 2, 3, 4, 5]
";

#[test]
fn every_form_is_read() {
    let message = read(MESSAGE).unwrap();
    assert_eq!(message.frame_id.as_deref(), Some("optical"));
    let lens = Distortion::rational_polynomial([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
    assert_eq!(message.camera.distortion(), &lens);
    let old = MESSAGE.replace("\nd:", "\nD:").replace("\nk:", "\nK:").replace("\nr:", "\nR:");
    assert_eq!(read(&old).unwrap(), message);
    let calibration = read(CALIBRATION).unwrap();
    assert_eq!(calibration.frame_id, None);
    let lens = Distortion::plumb_bob([1.0, 2.0, 3.0, 4.0, 5.0]);
    assert_eq!(calibration.camera.distortion(), &lens);
    for camera in [message.camera, calibration.camera] {
        assert_eq!((camera.width(), camera.height()), (4, 3));
        assert_eq!((camera.fx(), camera.fy(), camera.cx(), camera.cy()), (5.0, 6.0, 1.5, 1.0));
    }
}

#[test]
fn only_the_first_document_counts() {
    let first = read(MESSAGE).unwrap();
    assert_eq!(read(&format!("---\n{MESSAGE}width: 9\n---\n")).unwrap(), first);
}

#[test]
fn lenses_that_bend_nothing() {
    for d in ["[]", "[0.0, 0.0]", "[0, 0, 0, 0, 0, 0, 0, 0]"] {
        let text = CAMERA_INFO.replace("[0.0, 0.0, 0.0, 0.0, 0.0]", d);
        for model in ["plumb_bob", "rational_polynomial", "\"\"", "none"] {
            let info = read(&text.replace("plumb_bob", model)).unwrap();
            assert_eq!(info.camera.distortion(), &Distortion::None);
        }
    }
    let without = CAMERA_INFO.replace("distortion_model: plumb_bob\n", "");
    let without = without.replace("d: [0.0, 0.0, 0.0, 0.0, 0.0]\n", "");
    assert_eq!(read(&without).unwrap().camera.distortion(), &Distortion::None);
}

#[test]
fn coefficients_fit_their_model() {
    let with = |d: &str| read(&CAMERA_INFO.replace("[0.0, 0.0, 0.0, 0.0, 0.0]", d));
    let four = Distortion::plumb_bob([0.1, 0.2, 0.3, 0.4, 0.0]);
    assert_eq!(with("[0.1, 0.2, 0.3, 0.4]").unwrap().camera.distortion(), &four);
    let padded = with("[0.1, 0.2, 0.3, 0.4, 0, 0, 0, 0]").unwrap();
    assert_eq!(padded.camera.distortion(), &four);
    assert_says(with("[0.1, 0.2]"), &["camera_info.yaml: d", "2 coefficients", "k1 k2 p1 p2 k3"]);
    assert_says(with("[1, 1, 1, 1, 1, 1]"), &["6 coefficients", "plumb_bob"]);
    assert_says(with("[.nan, 1, 1, 1, 1]"), &["camera_info.yaml", "finite"]);
    let none = CAMERA_INFO.replace("plumb_bob", "\"\"").replace("d: [0.0", "d: [0.1");
    assert_says(read(&none), &["5 coefficients", "model \"\""]);
    let fisheye = CAMERA_INFO.replace("plumb_bob", "equidistant");
    let parts = ["distortion_model", "\"equidistant\"", "plumb_bob and rational_polynomial"];
    assert_says(read(&fisheye), &parts);
}

#[test]
fn what_makes_no_camera() {
    let changed = |from: &str, to: &str| read(&CAMERA_INFO.replace(from, to));
    assert_says(changed("k: [5.0", "k: [0.0"), &["camera_info.yaml: k", "0 x 5", "Calibrate"]);
    assert_says(changed("k: [5.0", "k: [-5.0"), &["camera_info.yaml", "focal length"]);
    assert_says(changed("k: [5.0, 0.0", "k: [5.0, 0.1"), &["k", "[fx, 0, cx"]);
    assert_says(changed(", 1.0]\nframe", "]\nframe"), &["k", "8 numbers", "9"]);
    assert_says(changed("width: 4\n", ""), &["width", "missing", "ros2 topic echo"]);
    assert_says(changed("k:", "kk:"), &["camera_info.yaml: k", "missing"]);
    assert_says(changed("width: 4", "width: 0"), &["camera_info.yaml", "0 x 3"]);
    assert_says(changed("width: 4", "width: wide"), &["camera_info.yaml", "u32", "line 1"]);
    assert_says(read(""), &["camera_info.yaml", "empty"]);
}

#[test]
fn models_without_coefficients_bend_nothing_by_any_name() {
    for model in ["pinhole", "brown_conrady", "Plumb Bob", "inverse_brown_conrady", "PLUMB-BOB"] {
        let info = read(&CAMERA_INFO.replace("plumb_bob", &format!("\"{model}\""))).unwrap();
        assert_eq!(info.camera.distortion(), &Distortion::None, "{model}");
    }
    let bent = CAMERA_INFO.replace("d: [0.0", "d: [0.1");
    let lens = Distortion::plumb_bob([0.1, 0.0, 0.0, 0.0, 0.0]);
    for model in ["brown_conrady", "\"Plumb Bob\"", "radtan"] {
        let info = read(&bent.replace("plumb_bob", model)).unwrap();
        assert_eq!(info.camera.distortion(), &lens, "{model}");
    }
    // Whose coefficients these are, the name does not say.
    for model in ["pinhole", "inverse_brown_conrady", "fisheye"] {
        let parts = ["distortion_model", model, "not supported"];
        assert_says(read(&bent.replace("plumb_bob", model)), &parts);
    }
}

/// Forms of others, of the same camera.
const OTHERS: [(&str, &str); 7] = [
    (
        "Kalibr",
        "cam0:\n  camera_model: pinhole\n  intrinsics: [5.0, 6.0, 1.5, 1.0]\n  \
         distortion_model: radtan\n  distortion_coeffs: [0.0, 0.0, 0.0, 0.0]\n  \
         resolution: [4, 3]\n  rostopic: /cam/image_raw\n",
    ),
    (
        "librealsense",
        r#"{"width": 4, "height": 3, "ppx": 1.5, "ppy": 1.0, "fx": 5.0, "fy": 6.0,
            "model": "distortion.inverse_brown_conrady", "coeffs": [0.0, 0.0, 0.0, 0.0, 0.0]}"#,
    ),
    (
        "librealsense, with the model's number",
        r#"{"width": 4, "height": 3, "ppx": 1.5, "ppy": 1.0, "fx": 5.0, "fy": 6.0, "model": 4,
            "coeffs": [0.0, 0.0, 0.0, 0.0, 0.0]}"#,
    ),
    (
        "Open3D",
        r#"{"width": 4, "height": 3,
            "intrinsic_matrix": [5.0, 0.0, 0.0, 0.0, 6.0, 0.0, 1.5, 1.0, 1.0]}"#,
    ),
    (
        "Open3D, with a pose",
        r#"{"class_name": "PinholeCameraParameters", "extrinsic": [1.0, 0.0], "intrinsic": {
            "width": 4, "height": 3,
            "intrinsic_matrix": [5.0, 0.0, 0.0, 0.0, 6.0, 0.0, 1.5, 1.0, 1.0]}}"#,
    ),
    (
        "rows of rows",
        r#"{"width": 4, "height": 3,
            "intrinsic_matrix": [[5.0, 0.0, 1.5], [0.0, 6.0, 1.0], [0.0, 0.0, 1.0]]}"#,
    ),
    (
        "BOP",
        r#"{"cx": 1.5, "cy": 1.0, "depth_scale": 0.1, "fx": 5.0, "fy": 6.0, "height": 3,
            "width": 4}"#,
    ),
];

#[test]
fn forms_of_others_are_read() {
    for (form, text) in OTHERS {
        let info = read(text).unwrap_or_else(|error| panic!("{form}: {error}"));
        let camera = &info.camera;
        assert_eq!((camera.width(), camera.height()), (4, 3), "{form}");
        let numbers = [camera.fx(), camera.fy(), camera.cx(), camera.cy()];
        assert_eq!(numbers, [5.0, 6.0, 1.5, 1.0], "{form}");
        assert_eq!(camera.distortion(), &Distortion::None, "{form}");
        let unit = if form == "BOP" { Some(1e-4) } else { None };
        assert!(info.depth_unit_m.map(|m| (m - 1e-4).abs() < 1e-15) == unit.map(|_| true));
    }
}

#[test]
fn forms_that_could_mean_two_things_are_refused() {
    let (_, kalibr) = OTHERS[0];
    let two = format!("{kalibr}{}", kalibr.replace("cam0", "cam1"));
    assert_says(read(&two), &["cam1", "several cameras", "call it cam0"]);
    let omni = kalibr.replace("pinhole", "omni");
    assert_says(read(&omni), &["camera_model", "\"omni\"", "pinhole"]);
    let (_, open3d) = OTHERS[3];
    let odd = open3d.replace("1.5, 1.0, 1.0]", "1.5, 1.0, 2.0]");
    assert_says(read(&odd), &["intrinsic_matrix", "column by column"]);
    let (_, realsense) = OTHERS[2];
    assert_says(read(&realsense.replace("\"model\": 4", "\"model\": 9")), &["model", "9 is"]);
    // A scene_camera.json of BOP tells no size.
    let scene = r#"{"0": {"cam_K": [5.0, 0.0, 1.5, 0.0, 6.0, 1.0, 0.0, 0.0, 1.0]}}"#;
    assert_says(read(scene), &["width", "missing"]);
}

#[test]
fn a_binned_camera_of_a_folder_is_that_of_its_images() {
    let sample = Sample::depth();
    let whole = "width: 8\nheight: 6\nk: [10.0, 0.0, 3.0, 0.0, 10.0, 2.0, 0.0, 0.0, 1.0]\n";
    sample.write("camera_info.yaml", format!("{whole}binning_x: 2\nbinning_y: 2\n").as_bytes());
    let folder = sample.open().unwrap();
    let camera = folder.camera().unwrap();
    assert_eq!((camera.width(), camera.height(), camera.fx(), camera.cx()), (4, 3, 5.0, 1.5));
    folder.read_frame(0).unwrap();
}

#[test]
fn a_unit_that_the_cameras_file_tells_otherwise_is_refused() {
    let sample = Sample::depth();
    sample.write("camera_info.yaml", OTHERS[6].1.as_bytes());
    sample.describe("\"m\"", "\"mm\"");
    let parts = ["frames.depth_unit", "mm is written here", "says 0.0001 m"];
    assert_says(sample.open(), &parts);
    sample.describe("\"mm\"", "0.0001");
    sample.open().unwrap();
}
