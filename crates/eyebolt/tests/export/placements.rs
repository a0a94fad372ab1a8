//! Which pose is exported, over the calibration and static transforms.

use crate::json::{calibration, example, parsed};
use crate::poses::{config, pose};
use crate::trees::{ECHO, edge, shifted};
use eyebolt::export::{ExportError, Named, Note, Placement, SavedCalibration, StaticTree, Wanted};
use eyebolt_geometry::Transform;
use eyebolt_robot::Input;
use proptest::prelude::*;
use serde_json::Value;

fn saved() -> SavedCalibration {
    parsed(&calibration(&example()))
}

fn unnamed() -> SavedCalibration {
    let mut json = calibration(&example());
    json["frames"]["camera"] = Value::Null;
    parsed(&json)
}

fn echo() -> StaticTree {
    StaticTree::from_tf_message("tf.yaml", ECHO).unwrap()
}

fn tree(edges: &[(&str, &str)]) -> StaticTree {
    let edges = edges.iter().map(|(parent, child)| edge(parent, child, shifted(0.1)));
    StaticTree::from_edges("tf.yaml", edges.collect()).unwrap()
}

fn pair<'a>(parent: &'a str, child: &'a str) -> Wanted<'a> {
    Wanted { parent: Some(parent), child: Some(child), ..Wanted::default() }
}

fn find(tree: &StaticTree, wanted: &Wanted<'_>) -> Result<Placement, ExportError> {
    Placement::find(&saved(), tree, wanted)
}

fn names(placement: &Placement) -> [&str; 2] {
    [placement.parent.as_str(), placement.child.as_str()]
}

#[test]
fn the_optical_frame_in_the_base_unless_asked_otherwise() {
    let placement = find(&StaticTree::empty(), &Wanted::default()).unwrap();
    assert_eq!(names(&placement), ["base", "eye_optical"]);
    assert!(placement.child_is_optical && placement.notes.is_empty());
    assert_eq!(placement.parent_from_child.matrix(), example().matrix());
}

#[test]
fn a_camera_with_frames_of_its_own_is_placed_by_their_root() {
    let placement = find(&echo(), &Wanted::default()).unwrap();
    assert_eq!(names(&placement), ["base", "camera_link"]);
    assert!(!placement.child_is_optical);
    // By hand: camera_link -> depth is (0, -0.015, 1e-5), depth -> optical turns only.
    let link_from_optical =
        Transform::<Named, Named>::from_xyzw([0.0, -0.015, 1e-5], [-0.5, 0.5, -0.5, 0.5]).unwrap();
    let expected = example().matrix() * link_from_optical.inverse().matrix();
    assert!((placement.parent_from_child.matrix() - expected).amax() < 1e-15);
    let [note @ Note::ChildIsRoot { .. }] = &placement.notes[..] else {
        panic!("{:?}", placement.notes)
    };
    let note = note.to_string();
    for name in ["eye_optical has the parent camera_depth_frame", "pose of camera_link"] {
        assert!(note.contains(name), "{note}");
    }
}

#[test]
fn the_parent_may_be_above_the_base() {
    let wanted = Wanted { parent: Some("world"), ..Wanted::default() };
    let placement = find(&echo(), &wanted).unwrap();
    assert_eq!(names(&placement), ["world", "camera_link"]);
    let in_base = find(&echo(), &Wanted::default()).unwrap().parent_from_child;
    let raised = placement.parent_from_child.translation_m() - in_base.translation_m();
    assert!((raised - nalgebra::Vector3::new(0.0, 0.0, 0.75)).amax() < 1e-15);
}

#[test]
fn a_child_that_has_a_parent_is_told_of() {
    let placement = find(&echo(), &pair("base", "eye_optical")).unwrap();
    assert!(placement.child_is_optical);
    let [note] = &placement.notes[..] else { panic!("{:?}", placement.notes) };
    assert!(note.to_string().contains("two parents"), "{note}");
}

#[test]
fn a_tree_of_other_frames_is_told_of() {
    let placement = find(&tree(&[("d435_link", "d435_optical")]), &Wanted::default()).unwrap();
    let [note] = &placement.notes[..] else { panic!("{:?}", placement.notes) };
    let note = note.to_string();
    for words in ["tf.yaml has neither base nor eye_optical", "d435_optical", "`optical_frame`"] {
        assert!(note.contains(words), "{note}");
    }
    let wanted = Wanted { optical: Some("d435_optical"), ..Wanted::default() };
    let placement = find(&tree(&[("d435_link", "d435_optical")]), &wanted).unwrap();
    assert_eq!(names(&placement), ["base", "d435_link"]);
}

fn refusal(tree: &StaticTree, wanted: &Wanted<'_>) -> String {
    find(tree, wanted).unwrap_err().to_string()
}

#[test]
fn frames_that_are_nowhere_are_answered_with_those_there_are() {
    let error = refusal(&StaticTree::empty(), &pair("base", "camera_link"));
    for words in ["no frame is called camera_link", "base, eye_optical", "`camera_tree`"] {
        assert!(error.contains(words), "{error}");
    }
    assert!(refusal(&echo(), &pair("map", "camera_link")).contains("no frame is called map"));
    let many: Vec<String> = (0..100).map(|index| format!("f{index:03}")).collect();
    let many: Vec<_> = many.windows(2).map(|w| edge(&w[0], &w[1], shifted(0.1))).collect();
    let many = StaticTree::from_edges("tf.yaml", many).unwrap();
    assert!(refusal(&many, &pair("map", "f001")).contains("f037 and 62 more"));
}

#[test]
fn frames_that_nothing_connects_are_told_apart() {
    let apart = tree(&[("map", "odom"), ("camera_link", "eye_optical")]);
    let error = find(&apart, &pair("map", "camera_link")).unwrap_err();
    assert_eq!(error.input(), Some(Input::CAMERA_TREE));
    let error = refusal(&apart, &pair("map", "camera_link"));
    for words in [
        "lead from map to camera_link",
        "map is connected to odom;",
        "not connected to base, camera_link, eye_optical",
    ] {
        assert!(error.contains(words), "{error}");
    }
}

#[test]
fn one_frame_has_no_pose_in_itself() {
    assert!(refusal(&echo(), &pair("base", "/base")).contains("both base"));
    let wanted = Wanted { optical: Some("base"), ..Wanted::default() };
    assert!(refusal(&StaticTree::empty(), &wanted).contains("both base"));
}

#[test]
fn an_earlier_calibration_must_go_first() {
    let earlier = tree(&[("base", "camera_link"), ("camera_link", "eye_optical")]);
    let error = refusal(&earlier, &Wanted::default());
    for words in ["tf.yaml", "base - camera_link - eye_optical", "earlier calibration"] {
        assert!(error.contains(words), "{error}");
    }
}

#[test]
fn names_asked_for_are_checked() {
    assert!(refusal(&StaticTree::empty(), &pair("base", "-x")).contains("dash"));
}

#[test]
fn a_camera_without_a_name_gets_one() {
    let empty = StaticTree::empty();
    let error = Placement::find(&unnamed(), &empty, &Wanted::default()).unwrap_err();
    assert_eq!(error.input(), Some(Input::OPTICAL_FRAME));
    let error = error.to_string();
    assert!(error.contains("frames.camera") && error.contains("`optical_frame`"), "{error}");
    for wanted in [
        Wanted { optical: Some("eye"), ..Wanted::default() },
        Wanted { child: Some("eye"), ..Wanted::default() },
    ] {
        let placement = Placement::find(&unnamed(), &empty, &wanted).unwrap();
        assert_eq!(names(&placement), ["base", "eye"]);
        assert!(placement.child_is_optical);
    }
    // With other frames of the camera about, the child need not be the optical one.
    let wanted = Wanted { child: Some("camera_link"), ..Wanted::default() };
    assert!(Placement::find(&unnamed(), &echo(), &wanted).is_err());
}

#[test]
fn a_refused_pose_comes_with_its_reasons() {
    let mut json = calibration(&example());
    json["verdict"] = "refused".into();
    json["reasons"] = vec!["a rival pose"].into();
    let wanted = Wanted { even_if_refused: true, ..Wanted::default() };
    let placement = Placement::find(&parsed(&json), &StaticTree::empty(), &wanted).unwrap();
    let [note] = &placement.notes[..] else { panic!("{:?}", placement.notes) };
    assert!(note.to_string().contains("a rival pose"), "{note}");
}

proptest! {
    #![proptest_config(config(256))]

    /// base_from_camera = base_from_mount mount_from_link link_from_optical, whatever is asked for,
    /// and however the tree tells it.
    #[test]
    fn poses_compose_along_the_way(up in pose(), down in pose(), side in pose()) {
        let edges = vec![
            edge("world", "base", up),
            edge("link", "eye_optical", down),
            edge("link", "imu", side),
        ];
        let tree = StaticTree::from_edges("tf.yaml", edges).unwrap();
        let get = |parent, child| find(&tree, &pair(parent, child)).unwrap().parent_from_child.matrix();
        let base_from_optical = example().matrix();
        let size = [up, down, side].iter().fold(1.0, |s, p| s + p.translation_m().norm());
        let expected = up.matrix() * base_from_optical * down.inverse().matrix() * side.matrix();
        prop_assert!((get("world", "imu") - expected).amax() < 1e-14 * size);
        prop_assert!((get("world", "imu") * get("imu", "world") - nalgebra::Matrix4::identity()).amax()
            < 1e-14 * size * size);
        prop_assert!((get("link", "eye_optical") - down.matrix()).amax() < 1e-15 * size);
        prop_assert!((get("world", "base") * get("base", "imu") - expected).amax() < 1e-14 * size);
    }

    /// By the text of a message, too.
    #[test]
    fn poses_survive_their_text(pose in pose()) {
        let ([x, y, z], [qx, qy, qz, qw]) = (pose.translation_m().into(), pose.rotation_xyzw());
        let text = format!(
            "transforms: [{{header: {{frame_id: a}}, child_frame_id: b, transform: {{translation: \
             {{x: {x:?}, y: {y:?}, z: {z:?}}}, \
             rotation: {{x: {qx:?}, y: {qy:?}, z: {qz:?}, w: {qw:?}}}}}}}]"
        );
        let tree = StaticTree::from_tf_message("tf.yaml", &text).unwrap();
        let placement = find(&tree, &pair("a", "b")).unwrap();
        let off = (placement.parent_from_child.matrix() - pose.matrix()).amax();
        prop_assert!(off < 1e-15, "{off:e}");
    }
}
