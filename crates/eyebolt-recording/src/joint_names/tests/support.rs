//! Robots that have but joints.

use eyebolt_robot::{PackageRoots, Robot};

/// One joint after the other.
pub(super) fn robot(joints: &[&str]) -> Robot {
    let mut urdf = String::from(r#"<robot><link name="base"/>"#);
    let mut parent = "base".to_owned();
    for joint in joints {
        urdf += &format!(
            r#"<link name="of_{joint}"/><joint name="{joint}" type="continuous">
            <parent link="{parent}"/><child link="of_{joint}"/></joint>"#
        );
        parent = format!("of_{joint}");
    }
    Robot::from_urdf_str(&(urdf + "</robot>"), None, &PackageRoots::new()).unwrap()
}
