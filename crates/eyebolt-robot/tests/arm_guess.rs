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

/// A link with a box, hung on `parent` by a joint of `kind` called `joint`.
fn part(parent: &str, name: &str, joint: &str, kind: &str, inside: &str) -> String {
    format!(
        r#"<link name="{name}"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
        <joint name="{joint}" type="{kind}"><parent link="{parent}"/><child link="{name}"/>{inside}</joint>"#
    )
}

/// IRB 2400, M-900iA: rods that follow a joint of the chain and lead nowhere.
#[test]
fn rods_of_a_parallelogram_are_no_fingers() {
    let follows = r#"<mimic joint="arm2_joint" multiplier="-1"/>"#;
    for at in 1..=3 {
        let rod = part(&format!("arm{at}"), "rod", "rod_joint", "revolute", follows);
        let end = part("rod", "rod_end", "rod_end_joint", "revolute", follows);
        for parts in [
            vec![chain("base", "arm", "revolute", 6), rod.clone()],
            vec![chain("base", "arm", "revolute", 6), rod.clone(), end.clone()],
        ] {
            // A rod that hangs above the joint that it follows is told by being shorter.
            assert_eq!(guessed(&robot(&parts)), names("base", "arm6"), "{at}");
        }
        // Without a mimic, as some write it.
        let loose = part(&format!("arm{at}"), "rod", "rod_joint", "revolute", "");
        let parts = [chain("base", "arm", "revolute", 6), loose];
        assert_eq!(guessed(&robot(&parts)), names("base", "arm6"), "{at}");
    }
    // Fingers that follow each other are fingers.
    let right = r#"<mimic joint="left1_joint"/>"#;
    let parts = [
        chain("base", "arm", "revolute", 6),
        chain("arm6", "left", "prismatic", 1),
        part("arm6", "right", "right_joint", "prismatic", right),
    ];
    assert_eq!(guessed(&robot(&parts)), names("base", "arm6"));
}

/// Stretch: a lift and an arm that slides out, and a camera's head that turns as often as the wrist.
#[test]
fn a_camera_head_is_no_arm() {
    let parts = [
        chain("base", "wheel_left", "continuous", 1),
        chain("base", "wheel_right", "continuous", 1),
        chain("base", "head", "revolute", 2),
        chain("base", "lift", "prismatic", 2),
        chain("lift2", "wrist", "revolute", 1),
        part("wrist1", "gripper_finger_left", "joint_gripper_finger_left", "revolute", ""),
        part("wrist1", "gripper_finger_right", "joint_gripper_finger_right", "revolute", ""),
    ];
    assert_eq!(guessed(&robot(&parts)), names("base", "wrist1"));
}

/// SO-100: five joints, and one that turns a jaw.
#[test]
fn a_jaw_is_no_axis_of_the_wrist() {
    for (link, joint) in
        [("Moving_Jaw", "6"), ("moving", "gripper"), ("finger_link", "joint6"), ("claw", "j")]
    {
        let parts =
            [chain("base", "arm", "revolute", 5), part("arm5", link, joint, "revolute", "")];
        assert_eq!(guessed(&robot(&parts)), names("base", "arm5"), "{link}");
    }
    for joint in ["wrist_roll", "gripper_roll_joint", "joint_6"] {
        let parts =
            [chain("base", "arm", "revolute", 5), part("arm5", "palm", joint, "revolute", "")];
        assert_eq!(guessed(&robot(&parts)), names("base", "palm"), "{joint}");
    }
}

/// On a UR, `base_link_inertia` carries the geometry and is turned by 180 degrees in `base_link`.
#[test]
fn base_link_comes_before_what_carries_its_geometry() {
    let ur = |prefix: &str| {
        format!(
            r#"<robot><link name="world"/><link name="{prefix}base_link"/>
            <joint name="m" type="fixed"><parent link="world"/><child link="{prefix}base_link"/></joint>
            {}{}</robot>"#,
            part(
                &format!("{prefix}base_link"),
                "base_link_inertia",
                "i",
                "fixed",
                r#"<origin rpy="0 0 3.14159"/>"#
            ),
            chain("base_link_inertia", "arm", "revolute", 6)
        )
    };
    for prefix in ["", "left_"] {
        let robot = common::parse(&ur(prefix)).unwrap();
        assert_eq!(guessed(&robot), names(&format!("{prefix}base_link"), "arm6"));
        let arm = robot.arm(None, None).unwrap();
        assert!(arm.guessed().base && arm.guessed().end_effector);
        let arm = robot.arm(Some("base_link_inertia"), Some("arm6")).unwrap();
        assert!(!arm.guessed().base && !arm.guessed().end_effector);
    }
}
