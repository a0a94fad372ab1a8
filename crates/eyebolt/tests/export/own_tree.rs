//! Exports over the frames that the recording itself told: no frame gets a second parent.

use crate::json::{calibration, example, parsed};
use eyebolt::export::{Format, Note, Placement, SavedCalibration, Wanted};
use eyebolt_geometry::{Base, Camera, Transform};
use proptest::prelude::*;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Parent and child, 0.1 m along x and turned by 60 degrees about z.
type Edge = (&'static str, &'static str);

/// What a driver and robot_state_publisher tell; the base's links hang on joints that move.
const CAMERA: [Edge; 3] =
    [("camera_link", "depth"), ("depth", "eye_optical"), ("camera_link", "color_optical")];
const ROBOT: [Edge; 2] = [("world", "base"), ("flange", "hand")];

fn fixed(edges: &[Edge]) -> Value {
    let edge = |(parent, child): &Edge| {
        json!({"parent": parent, "child": child, "translation_m": [0.1, 0.0, 0.0],
               "rotation_xyzw": [0.0, 0.0, 0.5, 0.75_f64.sqrt()]})
    };
    edges.iter().map(edge).collect()
}

fn saved(edges: &[Edge], pose: &Transform<Base, Camera>) -> SavedCalibration {
    let mut calibration = calibration(pose);
    calibration["static_transforms"] = fixed(edges);
    parsed(&calibration)
}

/// The parent of every frame in the recording's tree with the export in it, by what is published:
/// the words of the command.
fn parents(edges: &[Edge], placement: &Placement) -> BTreeMap<String, Vec<String>> {
    let command = String::from_utf8(Format::Tf2.write(placement, "eyebolt")).unwrap();
    let words: Vec<&str> = command.lines().last().unwrap().split(' ').collect();
    let after = |option: &str| words[words.iter().position(|w| *w == option).unwrap() + 1];
    let own = (after("--frame-id"), after("--child-frame-id"));
    let mut parents: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (parent, child) in edges.iter().copied().chain([own]) {
        let known = parents.entry(child.to_owned()).or_default();
        // The same transform is published anew.
        if !known.iter().any(|other| other == parent) {
            known.push(parent.to_owned());
        }
    }
    parents
}

#[track_caller]
fn assert_one_tree(edges: &[Edge], placement: &Placement) {
    let parents = parents(edges, placement);
    for (child, parents) in &parents {
        assert_eq!(parents.len(), 1, "{child} has the parents {parents:?}");
    }
    // And the camera is placed: from its optical frame one comes to what the base hangs on.
    let root = |frame: &str| {
        let mut frame = frame.to_owned();
        while let Some(above) = parents.get(&frame) {
            frame.clone_from(&above[0]);
        }
        frame
    };
    assert_eq!(root("eye_optical"), root("base"));
}

#[test]
fn the_root_of_the_cameras_frames_is_placed() {
    let edges = [&CAMERA[..], &ROBOT].concat();
    let placement =
        Placement::of_recording(&saved(&edges, &example()), &Wanted::default()).unwrap();
    assert_eq!((placement.parent.as_str(), placement.child.as_str()), ("base", "camera_link"));
    assert!(matches!(placement.notes[..], [Note::ChildIsRoot { .. }]), "{:?}", placement.notes);
    assert_one_tree(&edges, &placement);
}

#[test]
fn an_earlier_calibration_in_the_recording_is_replaced() {
    for earlier in [("base", "camera_link"), ("world", "camera_link")] {
        let edges = [&CAMERA[..], &ROBOT, &[earlier]].concat();
        let saved = saved(&edges, &example());
        let placement = Placement::of_recording(&saved, &Wanted::default()).unwrap();
        assert_eq!((placement.parent.as_str(), placement.child.as_str()), earlier);
        let [note @ Note::Replaces { .. }] = &placement.notes[..] else {
            panic!("{:?}", placement.notes)
        };
        assert!(note.to_string().contains(&format!("from {} to camera_link", earlier.0)), "{note}");
        assert_one_tree(&edges, &placement);
    }
}

#[test]
fn where_no_tree_is_known_that_is_said() {
    let placement = Placement::of_recording(&saved(&[], &example()), &Wanted::default()).unwrap();
    assert_eq!((placement.parent.as_str(), placement.child.as_str()), ("base", "eye_optical"));
    let [note @ Note::TreeUnknown { .. }] = &placement.notes[..] else {
        panic!("{:?}", placement.notes)
    };
    assert!(note.to_string().contains("no /tf_static") && note.to_string().contains("camera_tree"));
}

#[test]
fn a_recording_that_gives_a_frame_two_parents_withholds_no_pose() {
    let edges = [&CAMERA[..], &[("other", "depth")]].concat();
    let saved = saved(&edges, &example());
    assert!(saved.tree_problem().unwrap().contains("two parents, camera_link and other"));
    let placement = Placement::of_recording(&saved, &Wanted::default()).unwrap();
    assert_eq!(placement.child.as_str(), "eye_optical");
    assert!(matches!(placement.notes[0], Note::NoTree { .. }), "{:?}", placement.notes);
}

fn pose() -> impl Strategy<Value = Transform<Base, Camera>> {
    (prop::array::uniform3(-2.0..2.0_f64), prop::array::uniform4(0.1..1.0_f64)).prop_map(
        |(translation, [x, y, z, w])| {
            let length = (x * x + y * y + z * z + w * w).sqrt();
            Transform::from_xyzw(translation, [x, y, z, w].map(|q| q / length)).unwrap()
        },
    )
}

proptest! {
    /// By whatever chain the camera hangs on its root, following it from there gives the answer.
    #[test]
    fn following_the_tree_gives_the_calibration(pose in pose(), earlier in any::<bool>()) {
        let mut edges = [&CAMERA[..], &ROBOT].concat();
        if earlier {
            edges.push(("world", "camera_link"));
        }
        let saved = saved(&edges, &pose);
        let placement = Placement::of_recording(&saved, &Wanted::default()).unwrap();
        let step = Transform::<Base, Base>::from_xyzw(
            [0.1, 0.0, 0.0],
            [0.0, 0.0, 0.5, 0.75_f64.sqrt()],
        ).unwrap().matrix();
        let mut base_from_optical = placement.parent_from_child.matrix() * step * step;
        if earlier {
            base_from_optical = step.try_inverse().unwrap() * base_from_optical;
        }
        prop_assert!((base_from_optical - pose.matrix()).amax() < 1e-9);
    }
}
