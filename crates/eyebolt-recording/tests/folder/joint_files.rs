//! Joints in CSV and JSON are those of NPY.

use crate::sample::{Sample, npy_f64};
use eyebolt_recording::FrameSource;
use proptest::prelude::*;

const NPY: &str = "joints_{}.npy";
const NAMES: &str = "joint_names = [\"shoulder\", \"elbow\"]\n";

/// A recording whose joints are in files of this pattern, with or without names.
pub fn with_joints(pattern: &str, named: bool) -> Sample {
    let sample = Sample::depth();
    sample.describe(NPY, pattern);
    if !named {
        sample.describe(NAMES, "");
    }
    sample
}

/// A recording whose joints are in one file.
pub fn with_table(name: &str, text: &str, named: bool) -> Sample {
    let sample = with_joints(name, named);
    sample.write(name, text.as_bytes());
    sample
}

/// A recording whose joints are in a file for each frame, all of the same text.
pub fn with_files(extension: &str, text: &str, named: bool) -> Sample {
    let sample = with_joints(&format!("joints_{{}}.{extension}"), named);
    for frame in ["2", "10"] {
        sample.write(&format!("joints_{frame}.{extension}"), text.as_bytes());
    }
    sample
}

proptest! {
    // Every case writes folders.
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn every_form_is_the_same(a in -3.0_f64..3.0, b in -3.0_f64..3.0) {
        let sample = Sample::depth();
        sample.write("joints_2.npy", &npy_f64(&[2], &[a, b]));
        let expected = sample.open().unwrap().read_joints(0).unwrap();
        let csv = format!("shoulder, elbow\r\n{a}, {b}\r\n");
        let stamped = format!("stamp,elbow,frame,shoulder\n17:04,{b},2,{a}\n");
        let object = format!("{{\"stamp\": [], \"elbow\": {b}, \"shoulder\": {a}}}");
        let state = format!(
            "{{\"header\": {{\"frame_id\": \"\"}}, \"name\": [\"elbow\", \"shoulder\"], \
             \"position\": [{b}, {a}], \"velocity\": []}}"
        );
        for named in [true, false] {
            for (extension, text) in
                [("csv", &csv), ("csv", &stamped), ("json", &object), ("json", &state)]
            {
                let sample = with_files(extension, text, named);
                prop_assert_eq!(&sample.frame().unwrap().joints, &expected);
            }
            let other = "{\"shoulder\": 0, \"elbow\": 0}";
            for (name, text) in [
                ("joints.csv", format!("frame,shoulder,elbow\n10,0,0\n02,{a},{b}\n")),
                ("joints.JSON", format!("{{\"10\": {other}, \"2\": {object}}}")),
                ("joints.json", format!("\u{feff}{{\"10\": {other}, \"002\": {state}}}")),
                ("joints.json", format!(
                    "[{{\"frame\": 2, \"shoulder\": {a}, \"elbow\": {b}}}, {}]",
                    state.replace("\"header\"", "\"frame\": \"10\", \"header\"")
                )),
            ] {
                let sample = with_table(name, &text, named);
                let folder = sample.open().unwrap();
                prop_assert_eq!(&folder.read_joints(0).unwrap(), &expected);
                prop_assert_eq!(&folder.read_frame(0).unwrap().joints, &expected);
                prop_assert_eq!(folder.read_joints(1).unwrap().len(), 2);
            }
        }
        for text in [format!("{a},{b}\n"), format!("{a}\n{b}\n"), format!("{a:e} , {b:e}")] {
            prop_assert_eq!(&with_files("csv", &text, true).frame().unwrap().joints, &expected);
        }
    }
}

#[test]
fn names_choose_the_joints() {
    let csv = "time,elbow,tool,shoulder,state\n1,0.5,7,0.25,moving\n";
    let json = "{\"tool\": {}, \"elbow\": 0.5, \"shoulder\": 0.25, \"state\": \"moving\"}";
    let state = "{\"name\": [\"tool\", \"elbow\", \"shoulder\"], \"position\": [null, 0.5, 0.25]}";
    for (extension, text) in [("csv", csv), ("json", json), ("json", state)] {
        let joints = with_files(extension, text, true).frame().unwrap().joints;
        let pairs: Vec<_> = joints.iter().collect();
        assert_eq!(pairs, [("elbow", 0.5), ("shoulder", 0.25)]);
    }
}

#[test]
fn tables_are_read_once_and_rows_of_other_frames_do_not_matter() {
    let text = "frame,shoulder\n1,far\n2,0.5\n10,0.25\n11,-\n";
    let sample = with_table("joints.csv", text, false);
    let folder = sample.open().unwrap();
    sample.remove("joints.csv");
    let position = |index| folder.read_joints(index).unwrap().get("shoulder");
    assert_eq!((position(0), position(1)), (Some(0.5), Some(0.25)));
}

#[test]
fn names_come_before_numbers() {
    let sample = with_table("joints.csv", "frame,a\n02,0.2\n2,0.4\n10,0.6\n", false);
    for (pattern, of) in [("depth_02.npy", "depth_2.npy"), ("mask_02.png", "mask_2.png")] {
        sample.write(pattern, &sample.read(of));
    }
    sample.write("color_02.png", &sample.read("color_2.png"));
    let folder = sample.open().unwrap();
    assert_eq!(folder.frame_names(), ["02", "2", "10"]);
    let positions = [0, 1, 2].map(|i| folder.read_joints(i).unwrap().get("a").unwrap());
    assert_eq!(positions, [0.2, 0.4, 0.6]);
}
