//! Every mistake in a recording is told with its file, field and remedy.

use crate::sample::{HEIGHT, PIXELS, Sample, WIDTH, assert_says, npy, npy_f32, npy_f64, npy_u16};
use crate::sample::{npy_with_header, png, png_u16};
use eyebolt_recording::{Folder, FrameSource};
use png::{BitDepth, ColorType};

/// A depth recording whose description has been changed.
#[track_caller]
fn described(from: &str, to: &str, parts: &[&str]) {
    let sample = Sample::depth();
    sample.describe(from, to);
    let parts: Vec<_> = parts.iter().chain(&["recording.toml"]).copied().collect();
    assert_says(sample.open(), &parts);
}

#[test]
fn unknown_keys_are_refused_with_the_nearest() {
    described("depth =", "depht =", &["frames.depht", "Did you mean \"depth\"?", "joint_names"]);
    described("[robot]", "[robots]", &["robots", "Did you mean \"robot\"?"]);
    described("end_effector =", "tool =", &["robot.tool", "Remove it", "end_effector"]);
    described("info =", "infos =", &["camera.infos", "Did you mean \"info\"?"]);
}

#[test]
fn toml_errors_name_the_line() {
    described("[camera]", "[camera", &["line 2", "Correct it"]);
    described("depth = \"depth_{}.npy\"", "depth = 3", &["line 6", "integer", "string"]);
    described("[frames]", "", &["camera.", "not known"]);
}

#[test]
fn depth_or_cloud_but_not_both() {
    described("mask =", "cloud = \"xyz_{}.npy\"\nmask =", &["both depth and cloud", "Keep one"]);
    described("depth = \"depth_{}.npy\"\n", "", &["neither depth nor cloud", "depth_{}.npy"]);
    described("mask =", "cloud_frame = \"body\"\nmask =", &["cloud_frame", "no clouds"]);
}

#[test]
fn units_and_frames_are_said() {
    described("\"m\"", "3", &["frames.depth_unit", "found 3", "0.0001"]);
    described("\"m\"", "\"cm\"", &["frames.depth_unit", "\"cm\"", "\"m\" (metres)", "\"mm\""]);
    described("depth_unit = \"m\"\n", "", &["frames.depth_unit", "missing", "never guessed"]);
    let sample = Sample::cloud();
    sample.describe("depth_unit = \"m\"\n", "");
    assert_says(sample.open(), &["frames.depth_unit", "missing"]);
    let sample = Sample::cloud();
    sample.describe("\"optical\"", "\"ros\"");
    assert_says(sample.open(), &["frames.cloud_frame", "\"ros\"", "\"optical\"", "\"body\""]);
    sample.describe("cloud_frame = \"ros\"\n", "");
    assert_says(sample.open(), &["frames.cloud_frame", "missing", "\"optical\"", "\"body\""]);
}

#[test]
fn patterns_have_one_place() {
    described("depth_{}", "depth_0", &["frames.depth", "no {}", "Write {}"]);
    described("mask_{}", "mask_{}_{}", &["frames.mask", "more than one {}"]);
    described("joints_{}.npy", "{}/joints.npy", &["frames.joints", "in its file name"]);
    described("depth_{}.npy", "depth_{}.exr", &["frames.depth", "exr", ".npy or .png"]);
}

#[test]
fn required_keys() {
    described("info = \"camera_info.yaml\"", "", &["camera.info", "missing", "camera_info.yaml"]);
    described("joints = \"joints_{}.npy\"", "", &["frames.joints", "missing"]);
    let names = "joint_names = [\"shoulder\", \"elbow\"]";
    described(names, "", &["frames.joint_names", "missing", "NPY files carry no names"]);
    described("\"elbow\"", "\"shoulder\"", &["frames.joint_names", "shoulder", "twice"]);
}

#[test]
fn files_must_be_there() {
    let sample = Sample::depth();
    assert_says(Folder::open(&sample.file("nowhere")), &["nowhere", "cannot read", "Check"]);
    assert_says(sample.open().unwrap().read_frame(2), &["index 2", "2 frames"]);
    sample.remove("color_10.png");
    assert_says(sample.open(), &["frames.color", "frame 10", "color_10.png is missing"]);
    sample.remove("mask_2.png");
    assert_says(sample.open(), &["frames.mask", "frame 2", "mask_2.png is missing"]);
    sample.remove("joints_10.npy");
    assert_says(sample.open(), &["frames.joints", "frame 10", "joints_10.npy is missing"]);
    sample.remove("camera_info.yaml");
    assert_says(sample.open(), &["camera_info.yaml", "cannot read camera info"]);
    described("depth_{}", "range_{}", &["frames.depth", "range_{}.npy", "no file in"]);
    let sample = Sample::depth();
    sample.describe("depth_{}", "sub/depth_{}");
    assert_says(sample.open(), &["sub", "frames.depth", "cannot read"]);
    let empty = tempfile::tempdir().unwrap();
    assert_says(Folder::open(empty.path()), &["recording.toml", "cannot read"]);
}

#[test]
fn sizes_must_agree() {
    let sample = Sample::depth();
    sample.write("depth_2.npy", &npy_f32(&[WIDTH, HEIGHT], &[1.0; PIXELS]));
    let parts = ["depth_2.npy", "4 x 3", "3 x 4", "camera_info.yaml"];
    assert_says(sample.frame(), &parts);
    let sample = Sample::depth();
    let mask = png(5, 3, ColorType::Grayscale, BitDepth::Eight, &[255; 15]);
    sample.write("mask_2.png", &mask);
    assert_says(sample.frame(), &["mask_2.png", "5 x 3", "depth_2.npy", "4 x 3"]);
    sample.write("color_2.png", &mask);
    let color = sample.open().unwrap().read_color(0);
    assert_says(color, &["color_2.png", "5 x 3", "camera_info.yaml", "4 x 3"]);
    sample.describe("depth_{}.npy", "mask_{}.png");
    sample.describe("\"m\"", "\"mm\"");
    assert_says(sample.frame(), &["mask_2.png: depth", "5 x 3", "4 x 3"]);
}

#[test]
fn types_must_be_read_here() {
    let sample = Sample::depth();
    sample.write("depth_2.npy", &npy("<i4", false, &[HEIGHT, WIDTH], &[0; 4 * PIXELS]));
    assert_says(sample.frame(), &["depth_2.npy", "'<i4'", "float32, float64, uint16"]);
    sample.write("depth_2.npy", &npy("|O", false, &[HEIGHT, WIDTH], &[0; 4 * PIXELS]));
    assert_says(sample.frame(), &["depth_2.npy", "'|O'"]);
    let records = "{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (3, 4), }";
    sample.write("depth_2.npy", &npy_with_header(records, &[0; 4 * PIXELS]));
    assert_says(sample.frame(), &["depth_2.npy", "not a plain array's", "numpy.save"]);
    let sample = Sample::depth();
    sample.write("joints_2.npy", &npy_u16(&[2], &[0, 1]));
    assert_says(sample.frame(), &["joints_2.npy", "'<u2'", "float32, float64"]);
    let sample = Sample::depth();
    sample.describe("depth_{}.npy", "color_{}.png");
    sample.describe("\"m\"", "\"mm\"");
    assert_says(sample.frame(), &["color_2.png", "8-bit RGB", "16-bit grey"]);
}

#[test]
fn units_must_be_plausible() {
    let sample = Sample::depth();
    sample.write("depth_2.npy", &npy_u16(&[HEIGHT, WIDTH], &[800; PIXELS]));
    assert_says(sample.frame(), &["16-bit integers", "depth_unit = \"mm\""]);
    sample.write("depth_2.npy", &npy_f32(&[HEIGHT, WIDTH], &[800.0; PIXELS]));
    assert_says(sample.frame(), &["800 m", "looks like millimetres", "depth_unit = \"mm\""]);
    sample.describe("\"m\"", "\"mm\"");
    assert!(sample.frame().is_ok());
    sample.write("depth_2.npy", &npy_f32(&[HEIGHT, WIDTH], &[0.8; PIXELS]));
    assert_says(sample.frame(), &["0.8 mm", "looks like metres", "depth_unit = \"m\""]);
    let sample = Sample::depth();
    sample.describe("depth_{}.npy", "deep_{}.png");
    for name in ["deep_2.png", "deep_10.png"] {
        sample.write(name, &png_u16(WIDTH, HEIGHT, &[800; PIXELS]));
    }
    assert_says(sample.frame(), &["deep_2.png", "16-bit integers", "depth_unit = \"mm\""]);
    let sample = Sample::cloud();
    sample.write("xyz_2.npy", &npy_f32(&[HEIGHT, WIDTH, 3], &[900.0; 3 * PIXELS]));
    assert_says(sample.frame(), &["xyz_2.npy", "looks like millimetres"]);
}

#[test]
fn clouds_have_three_coordinates_and_masks_need_rows() {
    let sample = Sample::cloud();
    sample.write("xyz_2.npy", &npy_f32(&[3, PIXELS], &[1.0; 3 * PIXELS]));
    assert_says(sample.frame(), &["xyz_2.npy", "3 x 12", "points x 3"]);
    for shape in [&[PIXELS, 3][..], &[1, PIXELS, 3]] {
        sample.write("xyz_2.npy", &npy_f32(shape, &[1.0; 3 * PIXELS]));
        assert_says(sample.frame(), &["mask_2.png", "xyz_2.npy", "list of points", "remove"]);
    }
    sample.write("xyz_2.npy", &npy_f32(&[WIDTH, HEIGHT, 3], &[1.0; 3 * PIXELS]));
    assert_says(sample.frame(), &["mask_2.png", "4 x 3", "3 x 4", "xyz_2.npy"]);
    sample.write("camera_info.yaml", crate::sample::CAMERA_INFO.as_bytes());
    sample.describe("[frames]", "[camera]\ninfo = \"camera_info.yaml\"\n[frames]");
    assert_says(sample.frame(), &["xyz_2.npy", "3 x 4 points", "4 x 3", "camera_info.yaml"]);
}

#[test]
fn frames_must_have_depth() {
    for nothing in [0.0, f32::NAN, f32::INFINITY, -1.0] {
        let sample = Sample::depth();
        sample.write("depth_2.npy", &npy_f32(&[HEIGHT, WIDTH], &[nothing; PIXELS]));
        assert_says(
            sample.frame(),
            &["depth_2.npy: depth: no pixel has depth", "Leave this frame"],
        );
    }
    for nothing in [0.0, f32::NAN] {
        let sample = Sample::cloud();
        sample.write("xyz_2.npy", &npy_f32(&[HEIGHT, WIDTH, 3], &[nothing; 3 * PIXELS]));
        assert_says(sample.frame(), &["xyz_2.npy: cloud: it has no point", "Leave this frame"]);
    }
}

#[test]
fn masks_must_not_be_empty() {
    let sample = Sample::depth();
    let empty = png(WIDTH, HEIGHT, ColorType::Grayscale, BitDepth::Eight, &[0; PIXELS]);
    sample.write("mask_2.png", &empty);
    assert_says(sample.frame(), &["mask_2.png", "no pixel is set", "leave this frame out"]);
}

#[test]
fn joints_must_be_radians_of_every_name() {
    let sample = Sample::depth();
    sample.write("joints_2.npy", &npy_f64(&[3], &[0.0; 3]));
    assert_says(sample.frame(), &["joints_2.npy", "3 positions", "2 names", "joint_names"]);
    sample.write("joints_2.npy", &npy_f64(&[2, 2], &[0.0; 4]));
    assert_says(sample.frame(), &["joints_2.npy", "2 x 2", "one file per frame"]);
    sample.write("joints_2.npy", &npy_f64(&[], &[0.0]));
    assert_says(sample.frame(), &["joints_2.npy", "a single number"]);
    sample.write("joints_2.npy", &npy_f64(&[2], &[0.0, -90.0]));
    assert_says(sample.frame(), &["joints_2.npy", "elbow is -90", "looks like degrees", "radians"]);
    sample.write("joints_2.npy", &npy_f64(&[2], &[f64::NAN, 0.0]));
    assert_says(sample.frame(), &["joints_2.npy", "shoulder is NaN"]);
}
