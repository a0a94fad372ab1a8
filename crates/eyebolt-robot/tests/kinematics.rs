//! Forward kinematics: pinocchio's poses, and laws.
#![allow(clippy::unwrap_used)]

mod common;

use eyebolt_geometry::{Transform, frame};
use eyebolt_robot::{JointKind, JointPositions, KinematicsError, Robot};
use proptest::prelude::*;
use std::collections::BTreeMap;

#[derive(serde::Deserialize)]
struct Fixture {
    samples: Vec<Sample>,
}

/// Made by fixtures/make_kinematics.py: [x, y, z, qx, qy, qz, qw] per link.
#[derive(serde::Deserialize)]
struct Sample {
    positions: BTreeMap<String, f64>,
    root_from_links: BTreeMap<String, [f64; 7]>,
}

fn positions(pairs: &[(&str, f64)]) -> JointPositions {
    pairs.iter().map(|(name, position)| ((*name).to_owned(), *position)).collect()
}

/// All links agree with the fixture to 1e-9 m and 1e-9 in every quaternion coordinate.
fn agrees(robot: &Robot, file: &str, base: Option<&str>) {
    let text = std::fs::read_to_string(common::fixture(file)).unwrap();
    let fixture: Fixture = serde_json::from_str(&text).unwrap();
    let arm = robot.arm(base, None).unwrap();
    assert_eq!(fixture.samples.len(), 20);
    for sample in &fixture.samples {
        let expected = |link: &str| {
            let [x, y, z, qx, qy, qz, qw] = sample.root_from_links[link];
            Transform::<frame::Base, frame::Link>::from_xyzw([x, y, z], [qx, qy, qz, qw]).unwrap()
        };
        let root_from_base = expected(arm.base_name());
        let poses = arm.link_poses(&sample.positions.clone().into_iter().collect()).unwrap();
        for link in sample.root_from_links.keys() {
            let found = poses[robot.link_index(link).unwrap()].unwrap();
            let found = root_from_base.isometry() * found.isometry();
            let found = Transform::<frame::Base, frame::Link>::from_isometry(found);
            let (metres, radians) = found.distance_to(&expected(link));
            assert!(metres < 1e-9 && radians < 1e-9, "{link}: {metres} m, {radians} rad");
        }
    }
}

#[test]
fn small_arm_as_pinocchio() {
    agrees(&common::small_arm(), "small_arm.json", Some("pedestal"));
    agrees(&common::small_arm(), "small_arm.json", Some("world"));
}

#[test]
fn panda_as_pinocchio() {
    let Some(robot) = common::panda() else { return };
    agrees(&robot, "panda.json", None);
}

#[test]
fn lbr_as_pinocchio() {
    let Some(robot) = common::lbr() else { return };
    agrees(&robot, "lbr_med7.json", None);
}

const ARM: [&str; 4] = ["shoulder", "telescope", "elbow", "wrist"];

fn any_positions() -> impl Strategy<Value = Vec<(String, f64)>> {
    prop::array::uniform5(-3.0..3.0_f64).prop_map(|values| {
        let names = ARM.into_iter().chain(["left_finger_joint"]);
        names.map(str::to_owned).zip(values).collect()
    })
}

proptest! {
    /// Every pose is its parent's pose times the joint's; the end-effector's is the same both ways.
    #[test]
    fn poses_compose_along_the_tree(pairs in any_positions()) {
        let robot = common::small_arm();
        let arm = robot.arm(Some("pedestal"), None).unwrap();
        let positions: JointPositions = pairs.into_iter().collect();
        let poses = arm.link_poses(&positions).unwrap();
        for joint in robot.joints.iter().filter(|joint| joint.mimic.is_none()) {
            let position = positions.get(&joint.name).unwrap_or(0.0);
            let expected = poses[joint.parent].unwrap() * joint.parent_from_child(position);
            let (metres, radians) = poses[joint.child].unwrap().distance_to(&expected);
            prop_assert!(metres < 1e-12 && radians < 1e-12);
        }
        let end = arm.base_from_end_effector(&positions).unwrap();
        let link = poses[arm.end_effector()].unwrap();
        prop_assert!((end.matrix() - link.matrix()).amax() < 1e-12);
    }

    /// A joint moves only what is below it.
    #[test]
    fn moving_a_joint_leaves_the_rest(pairs in any_positions(), which in 0..4_usize) {
        let robot = common::small_arm();
        let arm = robot.arm(None, None).unwrap();
        let mut moved = pairs.clone();
        moved[which].1 += 0.1;
        let before = arm.link_poses(&pairs.into_iter().collect()).unwrap();
        let after = arm.link_poses(&moved.into_iter().collect()).unwrap();
        let child = robot.joints[robot.joint_index(ARM[which]).unwrap()].child;
        for (index, link) in robot.links.iter().enumerate() {
            let mut above = Some(index);
            while above.is_some_and(|l| l != child) {
                above = robot.links[above.unwrap()].parent.map(|(parent, _)| parent);
            }
            prop_assert_eq!(before[index] != after[index], above.is_some(), "{}", &link.name);
        }
    }

    /// Neither the order of links and joints in the file nor their names matter.
    #[test]
    fn order_and_names_do_not_matter(
        pairs in any_positions(),
        order in Just((0..24).collect::<Vec<usize>>()).prop_shuffle(),
    ) {
        let robot = common::small_arm();
        let arm = robot.arm(Some("pedestal"), Some("hand")).unwrap();
        let shuffled = common::parse(&shuffled_and_renamed(&order)).unwrap();
        let other = shuffled.arm(Some("pedestal_x"), Some("hand_x")).unwrap();
        let renamed = pairs.iter().rev().map(|(name, position)| (format!("{name}_x"), *position));
        let theirs = other.link_poses(&renamed.collect()).unwrap();
        let ours = arm.link_poses(&pairs.into_iter().collect()).unwrap();
        for (link, pose) in robot.links.iter().zip(ours) {
            let there = shuffled.link_index(&format!("{}_x", link.name)).unwrap();
            prop_assert_eq!(pose, theirs[there]);
        }
    }

    /// A mimic joint is where its own joint would be at the mimicked position.
    #[test]
    fn mimics_follow(finger in -0.1..0.1_f64) {
        let robot = common::small_arm();
        let arm = robot.arm(None, None).unwrap();
        let mut pairs: Vec<(&str, f64)> = ARM.into_iter().map(|name| (name, 0.3)).collect();
        pairs.push(("left_finger_joint", finger));
        let poses = arm.link_poses(&positions(&pairs)).unwrap();
        let right = 0.8 * finger + 0.002;
        for (name, value) in [("right_finger_joint", right), ("fingertip_joint", -20.0 * right)] {
            let joint = &robot.joints[robot.joint_index(name).unwrap()];
            let expected = poses[joint.parent].unwrap() * joint.parent_from_child(value);
            let (metres, radians) = poses[joint.child].unwrap().distance_to(&expected);
            prop_assert!(metres < 1e-12 && radians < 1e-12);
        }
        // Its own record counts only where the followed joint has none.
        pairs.push(("right_finger_joint", 0.7));
        prop_assert_eq!(&arm.link_poses(&positions(&pairs)).unwrap(), &poses);
        let at = pairs.iter().position(|(name, _)| *name == "left_finger_joint").unwrap();
        pairs.remove(at);
        pairs.push(("left_finger_joint", (0.7 - 0.002) / 0.8));
        let same = arm.link_poses(&positions(&pairs)).unwrap();
        pairs.pop();
        let own = arm.link_poses_with_defaults(&positions(&pairs)).unwrap().base_from_links;
        let tip = robot.link_index("fingertip").unwrap();
        let (metres, radians) = own[tip].unwrap().distance_to(&same[tip].unwrap());
        prop_assert!(metres < 1e-12 && radians < 1e-9);
    }
}

/// The small arm with its elements in another order and `_x` behind every name.
fn shuffled_and_renamed(order: &[usize]) -> String {
    let text = std::fs::read_to_string(common::fixture("small_arm.urdf")).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    let root = document.root_element();
    let elements: Vec<&str> =
        root.children().filter(|c| c.is_element()).map(|c| &text[c.range()]).collect();
    assert!(elements.len() <= order.len());
    let mut urdf = String::from("<robot>");
    for index in order.iter().filter(|index| **index < elements.len()) {
        let mut element = elements[*index].to_owned();
        for attribute in ["name", "link", "joint"] {
            let pieces: Vec<&str> = element.split(&format!(" {attribute}=\"")).collect();
            let renamed = pieces[1..].iter().map(|piece| piece.replacen('"', "_x\"", 1));
            let renamed: Vec<String> =
                std::iter::once(pieces[0].to_owned()).chain(renamed).collect();
            element = renamed.join(&format!(" {attribute}=\""));
        }
        urdf.push_str(&element);
    }
    urdf + "</robot>"
}

#[test]
fn every_missing_arm_joint_is_named() {
    let arm = common::small_arm().arm(None, None).unwrap();
    assert_eq!(arm.required_joints(), ARM);
    assert_eq!(arm.other_joints(), ["left_finger_joint"]);
    let error = arm.link_poses(&positions(&[("elbow", 0.1), ("panda_joint1", 0.2)])).unwrap_err();
    let text = error.to_string();
    for word in ["`shoulder`", "`telescope`", "`wrist`", "`elbow`", "`panda_joint1`", "URDF"] {
        assert!(text.contains(word), "{word} is not in {text}");
    }
    assert!(matches!(error, KinematicsError::MissingArmJoints { .. }));
    assert!(arm.base_from_end_effector(&JointPositions::default()).is_err());
}

#[test]
fn missing_fingers_are_another_error_and_can_be_defaulted() {
    let arm = common::small_arm().arm(None, None).unwrap();
    let pairs = ARM.map(|name| (name, 0.1));
    let error = arm.link_poses(&positions(&pairs)).unwrap_err();
    assert!(matches!(&error, KinematicsError::MissingOtherJoints { missing, .. }
        if missing == &["left_finger_joint"]));
    let defaulted = arm.link_poses_with_defaults(&positions(&pairs)).unwrap();
    assert_eq!(defaulted.defaulted_joints, ["left_finger_joint"]);
    let mut full = pairs.to_vec();
    full.push(("left_finger_joint", 0.005));
    assert_eq!(defaulted.base_from_links, arm.link_poses(&positions(&full)).unwrap());
}

#[test]
fn positions_are_checked() {
    let arm = common::small_arm().arm(None, None).unwrap();
    let mut pairs = ARM.map(|name| (name, 0.1)).to_vec();
    pairs.push(("left_finger_joint", 0.01));
    pairs.push(("wheel", f64::NAN));
    assert!(arm.link_poses(&positions(&pairs)).is_ok());
    assert_eq!(arm.unknown_joints(&positions(&pairs)), ["wheel"]);
    pairs[0].1 = 45.0;
    let outside = arm.joints_outside_limits(&positions(&pairs));
    assert_eq!(outside.len(), 1);
    assert_eq!((outside[0].joint.as_str(), outside[0].upper), ("shoulder", 2.5));
    assert_eq!((outside[0].kind, outside[0].position), (JointKind::Revolute, 45.0));
    pairs[3].1 = f64::INFINITY;
    let error = arm.link_poses(&positions(&pairs)).unwrap_err();
    assert!(matches!(error, KinematicsError::NotFinite { joint, .. } if joint == "wrist"));
}

#[test]
fn links_that_moving_joints_part_from_the_base_have_no_pose() {
    let robot = common::small_arm();
    let arm = robot.arm(Some("sleeve"), Some("hand")).unwrap();
    assert_eq!(arm.required_joints(), ["elbow", "wrist"]);
    let pairs = [("elbow", 0.1), ("wrist", 0.2), ("left_finger_joint", 0.01)];
    let poses = arm.link_poses(&positions(&pairs)).unwrap();
    for (link, pose) in robot.links.iter().zip(poses) {
        let above = ["world", "table", "pedestal", "upper_arm"].contains(&link.name.as_str());
        assert_eq!(pose.is_none(), above, "{}", link.name);
    }
}
