//! Which links are taken for base and end-effector.
#![allow(clippy::unwrap_used)]

mod common;

use eyebolt_robot::{Input, Robot};

fn guessed(robot: &Robot) -> (String, String) {
    let arm = robot.arm(None, None).unwrap();
    (arm.base_name().to_owned(), arm.end_effector_name().to_owned())
}

fn names(base: &str, end_effector: &str) -> (String, String) {
    (base.to_owned(), end_effector.to_owned())
}

#[test]
fn of_known_robots() {
    assert_eq!(guessed(&common::small_arm()), names("pedestal", "hand"));
    if let Some(panda) = common::panda() {
        assert_eq!(guessed(&panda), names("panda_link0", "panda_hand"));
        let arm = panda.arm(None, None).unwrap();
        let below: Vec<_> = arm.end_effector_links();
        let below: Vec<_> = below.iter().map(|link| panda.links[*link].name.as_str()).collect();
        let fingers = ["panda_leftfinger", "panda_rightfinger"];
        assert_eq!(
            below,
            [&["panda_hand", "panda_hand_sc", "panda_hand_tcp"][..], &fingers].concat()
        );
        assert_eq!(arm.required_joints().len(), 7);
        assert_eq!(arm.other_joints(), ["panda_finger_joint1"]);
    }
    if let Some(lbr) = common::lbr() {
        assert_eq!(guessed(&lbr), names("lbr_link_0", "lbr_link_7"));
    }
}

/// A chain of `joints` joints of `kind` below `parent`: links PREFIX1, PREFIX2, ...
fn chain(parent: &str, prefix: &str, kind: &str, joints: usize) -> String {
    let mut urdf = String::new();
    let mut parent = parent.to_owned();
    for i in 1..=joints {
        let link = format!("{prefix}{i}");
        urdf += &format!(
            r#"<link name="{link}"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
            <joint name="{link}_joint" type="{kind}"><parent link="{parent}"/><child link="{link}"/></joint>"#
        );
        parent = link;
    }
    urdf
}

fn robot(parts: &[String]) -> Robot {
    let base =
        r#"<link name="base"><visual><geometry><box size="1 1 1"/></geometry></visual></link>"#;
    common::parse(&format!("<robot>{base}{}</robot>", parts.concat())).unwrap()
}

#[test]
fn turning_fingers_are_no_arms() {
    let parts = [
        chain("base", "arm", "revolute", 6),
        chain("arm6", "left", "revolute", 2),
        chain("arm6", "right", "continuous", 3),
    ];
    assert_eq!(guessed(&robot(&parts)), names("base", "arm6"));
    // One finger that slides, the other fixed.
    let parts = [
        chain("base", "arm", "revolute", 6),
        chain("arm6", "hand", "fixed", 1),
        chain("hand1", "jaw", "prismatic", 1),
    ];
    assert_eq!(guessed(&robot(&parts)), names("base", "hand1"));
}

#[test]
fn a_lift_before_the_arm_belongs_to_the_arm() {
    let parts = [chain("base", "lift", "prismatic", 1), chain("lift1", "arm", "revolute", 5)];
    assert_eq!(guessed(&robot(&parts)), names("base", "arm5"));
}

#[test]
fn two_arms_are_ambiguous_until_one_is_named() {
    let two = robot(&[chain("base", "left", "revolute", 6), chain("base", "right", "revolute", 6)]);
    let error = two.arm(None, None).unwrap_err();
    assert_eq!(error.input(), Some(Input::END_EFFECTOR));
    let error = error.to_string();
    for word in ["left6", "right6", "`end_effector`"] {
        assert!(error.contains(word), "{word} is not in {error}");
    }
    assert_eq!(two.arm(None, Some("left6")).unwrap().required_joints().len(), 6);
    let longer =
        robot(&[chain("base", "left", "revolute", 5), chain("base", "right", "revolute", 6)]);
    assert_eq!(guessed(&longer), names("base", "right6"));
}

#[test]
fn two_bases_are_ambiguous_until_the_end_effector_tells() {
    let urdf = format!(
        r#"<robot><link name="world"/>{}{}{}{}</robot>"#,
        chain("world", "left_base", "fixed", 1),
        chain("world", "right_base", "fixed", 1),
        chain("left_base1", "left", "revolute", 6),
        chain("right_base1", "right", "revolute", 6),
    );
    let robot = common::parse(&urdf).unwrap();
    let error = robot.arm(None, None).unwrap_err();
    assert_eq!(error.input(), Some(Input::BASE));
    let error = error.to_string();
    for word in ["left_base1", "right_base1", "`base`"] {
        assert!(error.contains(word), "{word} is not in {error}");
    }
    assert_eq!(robot.arm(None, Some("right6")).unwrap().base_name(), "right_base1");
}

#[test]
fn names_must_exist_and_be_connected() {
    let robot = common::small_arm();
    let error = robot.arm(Some("bse"), None).unwrap_err();
    assert_eq!(error.input(), Some(Input::BASE));
    let error = error.to_string();
    assert!(error.contains("`bse`") && error.contains("`base`") && error.contains("pedestal"));
    let error = robot.arm(Some("hand"), Some("pedestal")).unwrap_err().to_string();
    assert!(error.contains("no moving joint") && error.contains("`end_effector`"), "{error}");
    let error = robot.arm(Some("hand"), Some("tcp")).unwrap_err().to_string();
    assert!(error.contains("no moving joint"), "{error}");
}
