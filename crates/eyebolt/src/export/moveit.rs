//! What MoveIt Calibration saves as the camera's pose: launch files.

use super::placement::Placement;
use super::python_launch::python_launch;
use super::text::{meaning_without_names, numbers, xml};
use super::tf2::ros1_arguments;
use super::urdf::roll_pitch_yaw;

pub(super) fn ros2(placement: &Placement) -> String {
    let title = [
        "Static transform publisher, as hand-eye calibration with MoveIt 2 saves it.",
        "EYE-TO-HAND",
    ];
    let rpy = roll_pitch_yaw(&placement.parent_from_child.rotation());
    python_launch(placement, title, &[format!("Roll, pitch, yaw as in URDF: {}", numbers(&rpy))])
}

pub(super) fn ros1(placement: &Placement) -> String {
    let pose = &placement.parent_from_child;
    let (xyz, rpy) = (pose.translation_m(), roll_pitch_yaw(&pose.rotation()));
    format!(
        "<launch>\n  \
           <!-- {} -->\n  \
           <!-- The rpy is of fixed axes X, Y, Z, as in a URDF. -->\n  \
           <!-- xyz=\"{}\" rpy=\"{}\" -->\n  \
           <node pkg=\"tf2_ros\" type=\"static_transform_publisher\" \
         name=\"camera_link_broadcaster\"\n      args=\"{}\" />\n</launch>\n",
        meaning_without_names(placement),
        numbers(xyz.as_slice()),
        numbers(&rpy),
        // roslaunch splits the attribute as a shell would.
        xml(&ros1_arguments(placement))
    )
}
