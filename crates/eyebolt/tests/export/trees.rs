//! Static transforms: which make trees, and from which files they are read.

use eyebolt::export::{FrameName, Named, StaticEdge, StaticTree};
use eyebolt_geometry::Transform;
use eyebolt_robot::PackageRoots;
use std::fs;
use std::path::Path;

pub fn edge(parent: &str, child: &str, pose: Transform<Named, Named>) -> StaticEdge {
    StaticEdge { parent: parent.to_owned(), child: child.to_owned(), parent_from_child: pose }
}

pub fn shifted(x_m: f64) -> Transform<Named, Named> {
    Transform::from_xyzw([x_m, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]).unwrap()
}

fn refusal(edges: Vec<StaticEdge>) -> String {
    let error = StaticTree::from_edges("tf.yaml", edges).unwrap_err().to_string();
    assert!(error.starts_with("tf.yaml: "), "{error}");
    error
}

#[test]
fn what_is_no_tree_is_refused_with_the_frame_named() {
    let twice = vec![edge("a", "c", shifted(0.1)), edge("b", "c", shifted(0.1))];
    assert!(refusal(twice).contains("frame c: it has two parents, a and b"));
    let changed = vec![edge("a", "c", shifted(0.1)), edge("a", "c", shifted(0.2))];
    assert!(refusal(changed).contains("frame c: two transforms to a differ"));
    let round = [("a", "b"), ("b", "c"), ("c", "a"), ("c", "d")];
    let round = round.map(|(parent, child)| edge(parent, child, shifted(0.1)));
    assert!(refusal(round.into()).contains("cycle"));
    assert!(refusal(vec![edge("a", "a", shifted(0.0))]).contains("frame a: it is above itself"));
    assert!(refusal(vec![edge("a", "b\n", shifted(0.0))]).contains("child_frame_id: frame name"));
    assert!(refusal(vec![edge("", "b", shifted(0.0))]).contains("frame_id: frame name"));
    assert!(refusal(vec![edge("a", "b", shifted(1e9))]).contains("frame b: farther than"));
    let nowhere = Transform::from_parts([f64::NAN, 0.0, 0.0].into(), shifted(0.0).rotation());
    assert!(refusal(vec![edge("a", "b", nowhere)]).contains("frame b: farther than"));
}

#[test]
fn a_transform_may_be_told_twice() {
    let edges = vec![edge("/a", "c", shifted(0.1)), edge("a", "/c", shifted(0.1))];
    let tree = StaticTree::from_edges("tf.yaml", edges).unwrap();
    assert_eq!(tree.root(&FrameName::new("c").unwrap()).as_str(), "a");
}

/// As `ros2 topic echo /tf_static` prints what two publishers say.
pub const ECHO: &str = "transforms:
- header:
    stamp:
      sec: 1700000000
      nanosec: 25
    frame_id: camera_link
  child_frame_id: camera_depth_frame
  transform:
    translation:
      x: 0.0
      y: -0.015
      z: 1.0e-05
    rotation:
      x: 0.0
      y: 0.0
      z: 0.0
      w: 1.0
- header:
    stamp:
      sec: 1700000000
      nanosec: 25
    frame_id: camera_depth_frame
  child_frame_id: eye_optical
  transform:
    translation:
      x: 0.0
      y: 0.0
      z: 0.0
    rotation:
      x: -0.5
      y: 0.5
      z: -0.5
      w: 0.5
---
transforms:
- header:
    stamp:
      sec: 1700000001
      nanosec: 0
    frame_id: world
  child_frame_id: base
  transform:
    translation:
      x: 0.0
      y: 0.0
      z: 0.75
    rotation:
      x: 0.0
      y: 0.0
      z: 0.0
      w: 1.0
---
";

/// The same by `rostopic echo` of ROS 1, in part.
const ROS1_ECHO: &str = "transforms: \n  - \n    header: \n      seq: 0\n      stamp: \n        \
     secs: 1700000000\n        nsecs: 25\n      frame_id: \"/camera_link\"\n    \
     child_frame_id: \"eye_optical\"\n    transform: \n      translation: \n        x: 1\n        \
     y: 0.0\n        z: 0.0\n      rotation: \n        x: 0.0\n        y: 0.0\n        z: 0.0\n        \
     w: 1.0\n---\n";

fn parent<'t>(tree: &'t StaticTree, child: &str) -> Option<&'t str> {
    tree.parent(&FrameName::new(child).unwrap()).map(FrameName::as_str)
}

#[test]
fn the_messages_of_all_publishers_are_one_tree() {
    let tree = StaticTree::from_tf_message("tf.yaml", ECHO).unwrap();
    assert_eq!(parent(&tree, "eye_optical"), Some("camera_depth_frame"));
    assert_eq!(parent(&tree, "camera_depth_frame"), Some("camera_link"));
    assert_eq!(parent(&tree, "base"), Some("world"));
    assert_eq!(parent(&tree, "world"), None);
    let tree = StaticTree::from_tf_message("tf.yaml", ROS1_ECHO).unwrap();
    assert_eq!(parent(&tree, "eye_optical"), Some("camera_link"));
}

#[test]
fn json_is_read_as_well() {
    let json = r#"{"transforms": [{"header": {"frame_id": "a"}, "child_frame_id": "b",
        "transform": {"translation": {"x": 1, "y": 0, "z": 0},
                      "rotation": {"x": 0, "y": 0, "z": 0, "w": 1}}}]}"#;
    assert_eq!(parent(&StaticTree::from_tf_message("tf.json", json).unwrap(), "b"), Some("a"));
}

#[test]
fn what_is_no_message_is_refused_with_field_and_remedy() {
    let cases = [
        ("", "transforms: there are none"),
        ("---\n", "transforms: there are none"),
        ("transforms: []\n", "transforms: there are none"),
        ("frames: []\n", "transforms: the field is missing"),
        ("transforms: 3\n", "transforms"),
        ("transforms:\n- '...'\n", "transforms"),
        ("transforms:\n- {}\n", "transforms[0].header: the field is missing"),
    ];
    for (text, words) in cases {
        let error = StaticTree::from_tf_message("tf.yaml", text).unwrap_err().to_string();
        assert!(error.starts_with("tf.yaml: ") && error.contains(words), "{error}");
        assert!(error.contains("ros2 topic echo --full-length /tf_static"), "{error}");
    }
    let damaged = [
        ("frame_id: camera_link\n", "\n", "transforms[0].header"),
        ("frame_id: camera_link\n", "frame_id: \"\"\n", "frame_id: frame name \"\""),
        ("  child_frame_id: eye_optical\n", "", "transforms[1].child_frame_id"),
        ("w: 0.5", "w: 0.9", "transforms[1].transform.rotation: the quaternion"),
        ("w: 0.5", "w: .nan", "transforms[1].transform.rotation: the quaternion"),
        ("y: -0.015", "y: .inf", "transforms[0].transform.translation: not a number"),
        ("y: -0.015", "y: left", "transforms: "),
    ];
    for (from, to, words) in damaged {
        assert!(ECHO.contains(from));
        let error = StaticTree::from_tf_message("tf.yaml", &ECHO.replacen(from, to, 1));
        let error = error.unwrap_err().to_string();
        assert!(error.starts_with("tf.yaml: ") && error.contains(words), "{error}");
    }
}

#[test]
fn a_urdf_gives_its_fixed_joints() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("camera.urdf");
    let urdf = r#"<?xml version="1.0"?><robot name="r"><link name="world"/><link name="base"/>
        <link name="arm"/>
        <joint name="feet" type="fixed"><parent link="world"/><child link="base"/>
          <origin xyz="0 0 0.75"/></joint>
        <joint name="turn" type="continuous"><parent link="base"/><child link="arm"/></joint>
        </robot>"#;
    fs::write(&path, urdf).unwrap();
    let tree = StaticTree::read(&path, &PackageRoots::new(), Path::new(".")).unwrap();
    assert_eq!((parent(&tree, "base"), parent(&tree, "arm")), (Some("world"), None));
    fs::write(&path, ECHO).unwrap();
    let tree = StaticTree::read(&path, &PackageRoots::new(), Path::new(".")).unwrap();
    assert_eq!(parent(&tree, "eye_optical"), Some("camera_depth_frame"));
}
