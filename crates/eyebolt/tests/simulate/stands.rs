//! Robots that do not end at their base frame: flanges and wheels below it, torsos above.

use crate::stage::{CACHE, small};
use eyebolt::simulate::{Plan, Scenario, Viewpoint, plan};
use eyebolt_robot::{Arm, PackageRoots, Robot};

fn link(name: &str, z: f64, size: [f64; 3]) -> String {
    let [x, y, height] = size;
    format!(
        r#"<link name="{name}"><visual><origin xyz="0 0 {z}"/><geometry><box size="{x} {y} {height}"/></geometry></visual></link>"#
    )
}

fn joint(kind: &str, parent: &str, child: &str, at: [f64; 3], axis: &str) -> String {
    let [x, y, z] = at;
    format!(
        r#"<joint name="{child}_joint" type="{kind}"><parent link="{parent}"/><child link="{child}"/>
        <origin xyz="{x} {y} {z}"/><axis xyz="{axis}"/>
        <limit lower="-1.8" upper="1.8" effort="1" velocity="1"/></joint>"#
    )
}

fn arm(urdf: &str, end_effector: &str) -> Arm {
    let robot = Robot::from_urdf_str(urdf, None, &PackageRoots::new()).unwrap();
    robot.arm(None, Some(end_effector)).unwrap()
}

/// A plan of three configurations, from wherever the seed puts the camera.
fn planned<'a>(arm: &'a Arm, urdf: &'a str) -> Plan<'a> {
    let viewpoint = Viewpoint::Within(eyebolt::simulate::Ranges::default());
    let scenario = Scenario { arm, urdf, viewpoint, configurations: 3, frames: 1, ..small() };
    plan(scenario, &CACHE).unwrap()
}

fn table_top_m(plan: &Plan<'_>) -> f64 {
    let table = plan.solids().iter().find(|solid| solid.name == "table").unwrap();
    f64::from(table.bounds().1.z)
}

/// A base that reaches 7 cm below its frame, and a first link that begins at the frame's height.
#[test]
fn a_base_that_reaches_below_its_frame_stands_on_the_table() {
    let urdf = [
        "<robot name=\"low\">".to_owned(),
        link("base", -0.03, [0.2, 0.2, 0.08]),
        link("a", -0.02, [0.1, 0.12, 0.16]),
        link("b", 0.15, [0.08, 0.05, 0.3]),
        link("c", 0.15, [0.06, 0.04, 0.3]),
        joint("revolute", "base", "a", [0.0, 0.0, 0.1], "0 0 1"),
        joint("revolute", "a", "b", [0.0, 0.0, 0.06], "0 1 0"),
        joint("revolute", "b", "c", [0.0, 0.0, 0.3], "0 1 0"),
        "</robot>".to_owned(),
    ]
    .concat();
    let arm = arm(&urdf, "c");
    let top = table_top_m(&planned(&arm, &urdf));
    assert!((top + 0.071).abs() < 1e-4, "{top}");
}

/// Two arms of six joints on a torso on wheels, and a head: what holds still is not drawn anywhere, the
/// wheels stand on the table, and the camera looks to where the arm reaches.
#[test]
fn a_robot_with_wheels_a_torso_and_two_arms_finds_configurations() {
    let mut urdf = "<robot name=\"tall\">".to_owned() + &link("base", 0.2, [0.5, 0.5, 0.3]);
    for (wheel, x, y) in [("w1", 0.2, 0.25), ("w2", 0.2, -0.25), ("w3", -0.2, 0.0)] {
        urdf += &link(wheel, 0.0, [0.1, 0.03, 0.1]);
        urdf += &joint("continuous", "base", wheel, [x, y, -0.03], "0 1 0");
    }
    urdf += &link("torso", 0.2, [0.2, 0.3, 0.5]);
    urdf += &joint("revolute", "base", "torso", [0.0, 0.0, 0.65], "0 0 1");
    urdf += &(link("pan", 0.05, [0.1, 0.1, 0.05]) + &link("tilt", 0.05, [0.1, 0.2, 0.1]));
    urdf += &joint("revolute", "torso", "pan", [0.0, 0.0, 0.5], "0 0 1");
    urdf += &joint("revolute", "pan", "tilt", [0.0, 0.0, 0.1], "0 1 0");
    for (side, y) in [("left", 0.25), ("right", -0.25)] {
        let mut parent = "torso".to_owned();
        for number in 1..=6 {
            let name = format!("{side}_{number}");
            let at = if number == 1 { [0.0, y, 0.35] } else { [0.0, 0.0, 0.2] };
            let axis = ["0 0 1", "0 1 0", "0 1 0", "0 0 1", "0 1 0", "0 0 1"][number - 1];
            urdf += &link(&name, 0.1, [0.06, 0.08, 0.16]);
            urdf += &joint("revolute", &parent, &name, at, axis);
            parent = name;
        }
    }
    urdf += "</robot>";
    let arm = arm(&urdf, "left_6");
    let plan = planned(&arm, &urdf);
    let top = table_top_m(&plan);
    assert!((top + 0.081).abs() < 1e-4, "{top}");
}
