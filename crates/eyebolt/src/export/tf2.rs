//! Commands that publish the transform on `/tf_static`.

use super::placement::Placement;
use super::text::{meaning, number, numbers, shell_word};

/// The options of ROS 2's `static_transform_publisher`, each with its value. It took numbers in
/// fixed places before, in one order for quaternions and another for angles.
pub(super) fn options(placement: &Placement) -> [(&'static str, String); 9] {
    let pose = &placement.parent_from_child;
    let ([x, y, z], [qx, qy, qz, qw]) = (pose.translation_m().into(), pose.rotation_xyzw());
    [
        ("--x", number(x)),
        ("--y", number(y)),
        ("--z", number(z)),
        ("--qx", number(qx)),
        ("--qy", number(qy)),
        ("--qz", number(qz)),
        ("--qw", number(qw)),
        ("--frame-id", placement.parent.as_str().to_owned()),
        ("--child-frame-id", placement.child.as_str().to_owned()),
    ]
}

/// The arguments of ROS 1's: `x y z qx qy qz qw parent child`, as words of a shell.
pub(super) fn ros1_arguments(placement: &Placement) -> String {
    let pose = &placement.parent_from_child;
    format!(
        "{} {} {} {}",
        numbers(pose.translation_m().as_slice()),
        numbers(&pose.rotation_xyzw()),
        shell_word(placement.parent.as_str()),
        shell_word(placement.child.as_str())
    )
}

pub(super) fn ros2(placement: &Placement) -> String {
    let options = options(placement).map(|(name, value)| format!(" {name} {}", shell_word(&value)));
    command(placement, &format!("ros2 run tf2_ros static_transform_publisher{}", options.concat()))
}

pub(super) fn ros1(placement: &Placement) -> String {
    let arguments = ros1_arguments(placement);
    command(placement, &format!("rosrun tf2_ros static_transform_publisher {arguments}"))
}

fn command(placement: &Placement, command: &str) -> String {
    let [direction, units] = meaning(placement);
    format!("# {direction}\n# {units}\n{command}\n")
}
