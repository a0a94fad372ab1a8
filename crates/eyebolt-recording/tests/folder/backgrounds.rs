//! Depth of the scene without the robot.

use crate::sample::{HEIGHT, PIXELS, Sample, WIDTH, assert_says, npy_f32, png_u16};
use eyebolt_recording::FrameSource;

/// Of two backgrounds, 9 and 10.
fn sample() -> Sample {
    let sample = Sample::depth();
    sample.describe("[robot]", "[background]\ndepth = \"empty_{}.npy\"\n\n[robot]");
    for (name, depth_m) in [("9", 1.5), ("10", 2.5)] {
        let depth = npy_f32(&[HEIGHT, WIDTH], &[depth_m; PIXELS]);
        sample.write(&format!("empty_{name}.npy"), &depth);
    }
    sample
}

/// What is said of the first background.
#[track_caller]
fn said_of(sample: &Sample, parts: &[&str]) {
    assert_says(sample.open().unwrap().read_background(0), parts);
}

#[test]
fn they_are_read_in_the_order_of_their_names() {
    let sample = sample();
    let folder = sample.open().unwrap();
    assert_eq!(folder.background_count(), 2);
    let first = |index| folder.read_background(index).unwrap().depth_m()[0];
    assert_eq!([first(0), first(1)], [1.5, 2.5]);
    assert_eq!(folder.frame_names(), ["2", "10"]);
    let said = ["recording.toml", "background index 2", "2 backgrounds, counted from 0"];
    assert_says(folder.read_background(2), &said);
    let none = Sample::depth().open().unwrap();
    assert_eq!(none.background_count(), 0);
    assert_says(none.read_background(0), &["background index 0", "0 backgrounds"]);
}

#[test]
fn they_have_a_unit_of_their_own_if_they_say_so() {
    let sample = sample();
    sample.describe("empty_{}.npy\"", "empty_{}.png\"\ndepth_unit = \"mm\"");
    sample.write("empty_1.png", &png_u16(WIDTH, HEIGHT, &[1250; PIXELS]));
    let folder = sample.open().unwrap();
    assert_eq!(folder.read_background(0).unwrap().depth_m(), [1.25; PIXELS]);
    assert_eq!(folder.background_count(), 1);
    sample.describe("\"mm\"", "\"cm\"");
    assert_says(sample.open(), &["background.depth_unit", "\"cm\"", "\"mm\" (millimetres)"]);
    // That of the frames.
    sample.describe("depth_unit = \"cm\"\n", "");
    said_of(&sample, &["empty_1.png", "integers, which cannot be metres", "depth_unit"]);
}

#[test]
fn nothing_may_be_seen() {
    let sample = sample();
    sample.write("empty_9.npy", &npy_f32(&[HEIGHT, WIDTH], &[f32::NAN; PIXELS]));
    assert_eq!(sample.open().unwrap().read_background(0).unwrap().depth_m(), [0.0; PIXELS]);
}

#[test]
fn files_that_do_not_fit_are_refused() {
    let sample = sample();
    sample.write("empty_9.npy", &npy_f32(&[WIDTH, HEIGHT], &[1.0; PIXELS]));
    let said = ["empty_9.npy", "the array is 4 x 3 (rows x columns)", "camera_info.yaml is 3 x 4"];
    said_of(&sample, &said);
    sample.write("empty_9.npy", &npy_f32(&[HEIGHT, WIDTH], &[1250.0; PIXELS]));
    said_of(&sample, &["empty_9.npy", "looks like millimetres"]);
    let whole = npy_f32(&[HEIGHT, WIDTH], &[1.0; PIXELS]);
    sample.write("empty_9.npy", &whole[..whole.len() - 3]);
    said_of(&sample, &["empty_9.npy", "depth"]);
    let folder = sample.open().unwrap();
    sample.remove("empty_9.npy");
    assert_says(folder.read_background(0), &["empty_9.npy", "cannot read depth"]);
}

#[test]
fn descriptions_that_do_not_fit_are_refused() {
    let said_of = |from: &str, to: &str, parts: &[&str]| {
        let sample = sample();
        sample.describe(from, to);
        let parts: Vec<_> = parts.iter().chain(&["recording.toml"]).copied().collect();
        assert_says(sample.open(), &parts);
    };
    said_of("[background]", "[backround]", &["backround", "Did you mean \"background\"?"]);
    said_of("depth = \"empty", "dept = \"empty", &["background.dept", "Did you mean \"depth\"?"]);
    said_of("depth = \"empty_{}.npy\"", "", &["background.depth", "missing", "background_{}.npy"]);
    said_of("empty_{}", "empty", &["background.depth", "no {}"]);
    said_of("empty_{}.npy", "empty_{}.ply", &["background.depth", ".npy or .png"]);
    said_of("empty_{}", "nothing_{}", &["background.depth", "no file", "nothing_{}.npy"]);
    let both = ["background.depth", "depth_2.npy is a frame by frames.depth too", "Rename"];
    said_of("empty_{}", "dept{}", &both);
    let elsewhere = sample();
    elsewhere.describe("empty_{}", "elsewhere/empty_{}");
    assert_says(elsewhere.open(), &["elsewhere", "the folder of background.depth"]);
}

#[test]
fn clouds_have_backgrounds_if_they_have_a_camera() {
    let sample = Sample::cloud();
    let background = "[background]\ndepth = \"empty_{}.npy\"\n\n[frames]";
    sample.describe("[frames]", background);
    sample.write("empty_0.npy", &npy_f32(&[HEIGHT, WIDTH], &[1.5; PIXELS]));
    assert_says(
        sample.open(),
        &["camera.info", "missing", "the background, which is a depth image"],
    );
    sample.write("camera_info.yaml", crate::sample::CAMERA_INFO.as_bytes());
    sample.describe("[background]", "[camera]\ninfo = \"camera_info.yaml\"\n\n[background]");
    let folder = sample.open().unwrap();
    assert_eq!(folder.read_background(0).unwrap().depth_m(), [1.5; PIXELS]);
}
