//! Arms with end-effectors made for tests.

use eyebolt::end_effector::{EndEffector, EndEffectorError};
use eyebolt_robot::{Arm, JointPositions, PackageRoots, Robot};
use nalgebra::Point3;
use std::path::Path;

/// An arm of one joint whose end-effector `hand` looks like `visuals`, with `rest` beside it.
pub fn arm(visuals: &str, rest: &str, folder: Option<&Path>) -> Arm {
    let urdf = format!(
        r#"<robot name="made"><link name="base"><visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual></link>
        <joint name="turn" type="revolute"><parent link="base"/><child link="hand"/>
        <origin xyz="0 0 0.4"/><axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
        <link name="hand">{visuals}</link>{rest}</robot>"#
    );
    let robot = Robot::from_urdf_str(&urdf, folder, &PackageRoots::new()).unwrap();
    robot.arm(Some("base"), Some("hand")).unwrap()
}

/// A visual of `geometry`, moved.
pub fn visual(xyz: &str, geometry: &str) -> String {
    format!(r#"<visual><origin xyz="{xyz}"/><geometry>{geometry}</geometry></visual>"#)
}

/// The end-effector of boxes and the like.
pub fn of(visuals: &[(&str, &str)]) -> Result<EndEffector, EndEffectorError> {
    let visuals: String = visuals.iter().map(|(xyz, geometry)| visual(xyz, geometry)).collect();
    EndEffector::of(&arm(&visuals, "", None))
}

/// A palm with two fingers of which the second follows the first.
pub fn two_fingers() -> Arm {
    let finger = visual("0 0 0.03", r#"<box size="0.015 0.01 0.06"/>"#);
    let joint = |name: &str, sign: &str, mimic: &str| {
        format!(
            r#"<joint name="slide_{name}" type="prismatic"><parent link="hand"/><child link="{name}"/>
            <origin xyz="0 0 0.05"/><axis xyz="0 {sign} 0"/>
            <limit lower="0" upper="0.04" effort="1" velocity="1"/>{mimic}</joint>
            <link name="{name}">{finger}</link>"#
        )
    };
    let rest = joint("left", "1", "") + &joint("right", "-1", r#"<mimic joint="slide_left"/>"#);
    // A connector at one side, without which a half turn could not be seen.
    let palm = visual("0 0 0.025", r#"<box size="0.05 0.18 0.05"/>"#)
        + &visual("0.04 0.06 0.02", r#"<box size="0.03 0.03 0.03"/>"#);
    arm(&palm, &rest, None)
}

/// Positions of these joints.
pub fn joints(positions: &[(&str, f64)]) -> JointPositions {
    positions.iter().map(|(name, position)| ((*name).to_owned(), *position)).collect()
}

/// The greatest distance of a point from the point of the same number.
pub fn apart_m(a: &[Point3<f64>], b: &[Point3<f64>]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}
