//! A fixed joint of a URDF.

use super::placement::Placement;
use super::text::{meaning_without_names, numbers, xml};
use nalgebra::{UnitQuaternion, Vector3};

/// A `<robot>` with the child's link and its joint, to be included by xacro or copied from.
pub(super) fn write(placement: &Placement) -> String {
    let pose = &placement.parent_from_child;
    let (parent, child) = (xml(placement.parent.as_str()), xml(placement.child.as_str()));
    format!(
        r#"<?xml version="1.0"?>
<!-- {} -->
<!-- Copy link and joint into the robot's URDF, or include this file by xacro. Leave out the link
     where the URDF has it. -->
<robot name="eyebolt_camera">
  <link name="{child}"/>
  <joint name="{parent}_to_{child}" type="fixed">
    <parent link="{parent}"/>
    <child link="{child}"/>
    <origin xyz="{}" rpy="{}"/>
  </joint>
</robot>
"#,
        meaning_without_names(placement),
        numbers(pose.translation_m().as_slice()),
        numbers(&roll_pitch_yaw(&pose.rotation())),
    )
}

/// Angles about the fixed axes x, y, z, in this order: `R = Rz(yaw) Ry(pitch) Rx(roll)`, radians.
///
/// Where the pitch is a right angle, only yaw and roll together tell the rotation, and each by
/// itself is noise. So roll is what is left once pitch and the yaw taken have been undone, whatever
/// that yaw is: the product is right to rounding everywhere.
pub(super) fn roll_pitch_yaw(rotation: &UnitQuaternion<f64>) -> [f64; 3] {
    let [x, y, z] = [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()]
        .map(|axis| rotation * axis.into_inner());
    let yaw = x.y.atan2(x.x);
    let pitch = (-x.z).atan2(x.x.hypot(x.y));
    let (sin, cos) = yaw.sin_cos();
    let roll = (z.x * sin - z.y * cos).atan2(y.y * cos - y.x * sin);
    [roll, pitch, yaw]
}
