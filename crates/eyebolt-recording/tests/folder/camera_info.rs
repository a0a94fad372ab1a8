//! The forms in which ROS writes a camera.

use crate::sample::{CAMERA_INFO, Sample, assert_says};
use eyebolt_geometry::Distortion;
use eyebolt_recording::{CameraInfo, RecordingError};

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
