//! The `.calib` file of easy_handeye2 (ROS 2): its message `HandeyeCalibration` as YAML.

use super::placement::Placement;
use super::text::{identifier, meaning, number, quoted};

/// Loaded by `name` from `~/.ros2/easy_handeye2/calibrations/NAME.calib`. A field that the message
/// has not would be an error there.
pub(super) fn write(placement: &Placement, name: &str) -> String {
    let pose = &placement.parent_from_child;
    let ([x, y, z], [qx, qy, qz, qw]) =
        (pose.translation_m().map(number).into(), pose.rotation_xyzw().map(number));
    let [direction, units] = meaning(placement);
    format!(
        "# {direction}
# {units}
parameters:
  name: {}
  calibration_type: eye_on_base
  robot_base_frame: {}
  robot_effector_frame: {}
  tracking_base_frame: {}
  tracking_marker_frame: {MARKER}
  freehand_robot_movement: true
  move_group_namespace: /
  move_group: manipulator
transform:
  translation:
    x: {x}
    y: {y}
    z: {z}
  rotation:
    x: {qx}
    y: {qy}
    z: {qz}
    w: {qw}
",
        quoted(&identifier(name)),
        quoted(placement.parent.as_str()),
        quoted(placement.end_effector.as_str()),
        quoted(placement.child.as_str()),
    )
}

/// There was no marker; publishers do not look at its frame, but the field must be there.
pub(super) const MARKER: &str = "no_marker";
