//! The YAML file of easy_handeye (ROS 1).

use super::easy_handeye2::MARKER;
use super::placement::Placement;
use super::text::{identifier, meaning, number, quoted};

/// Loaded by namespace from `~/.ros/easy_handeye/NAME.yaml`. Only the fields that every version
/// knows: one more would be an error there.
pub(super) fn write(placement: &Placement, name: &str) -> String {
    let pose = &placement.parent_from_child;
    let ([x, y, z], [qx, qy, qz, qw]) =
        (pose.translation_m().map(number).into(), pose.rotation_xyzw().map(number));
    let [direction, units] = meaning(placement);
    format!(
        "# {direction}
# {units}
parameters:
  namespace: {}
  eye_on_hand: false
  robot_base_frame: {}
  robot_effector_frame: {}
  tracking_base_frame: {}
  tracking_marker_frame: {MARKER}
  move_group_namespace: /
  move_group: manipulator
transformation:
  x: {x}
  y: {y}
  z: {z}
  qx: {qx}
  qy: {qy}
  qz: {qz}
  qw: {qw}
",
        quoted(&format!("/{}/", identifier(name))),
        quoted(placement.parent.as_str()),
        quoted(placement.end_effector.as_str()),
        quoted(placement.child.as_str()),
    )
}
