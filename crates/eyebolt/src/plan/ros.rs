//! A plan in the forms that ROS reads: YAML of messages.

use super::document::name;
use super::movable::MovableArm;
use super::next::Plan;
use std::fmt::Write;

/// A `trajectory_msgs/msg/JointTrajectory` through all configurations of `plan`, as `ros2 topic pub` and action clients read
/// it. Nothing if there are none.
pub fn trajectory(arm: &MovableArm, plan: &Plan) -> String {
    let mut text = head(
        "trajectory_msgs/msg/JointTrajectory: through each configuration, with a rest to record it",
    );
    text += "header:\n  stamp:\n    sec: 0\n    nanosec: 0\n  frame_id: ''\n";
    let names = arm.joints().iter().map(|joint| quoted(&joint.name));
    let _ = writeln!(text, "joint_names: [{}]", names.collect::<Vec<_>>().join(", "));
    text += if plan.trajectory.is_empty() { "points: []\n" } else { "points:\n" };
    for point in &plan.trajectory {
        let _ = writeln!(text, "- positions: {}", numbers(&point.positions));
        let _ = writeln!(text, "  velocities: {}", numbers(&point.velocities));
        let nanoseconds = (1e9 * point.at_s).round() as u64;
        let (sec, nanosec) = (nanoseconds / 1_000_000_000, nanoseconds % 1_000_000_000);
        text += "  accelerations: []\n  effort: []\n";
        let _ = writeln!(text, "  time_from_start:\n    sec: {sec}\n    nanosec: {nanosec}");
    }
    text
}

/// Each configuration of `plan` by its name as a `moveit_msgs/msg/RobotState`, for planners that find their own way.
pub fn moveit(arm: &MovableArm, plan: &Plan) -> String {
    let mut text = head("by name a moveit_msgs/msg/RobotState each: joint targets");
    let names: Vec<String> = arm.joints().iter().map(|joint| quoted(&joint.name)).collect();
    if plan.configurations.is_empty() {
        text += "{}\n";
    }
    for (index, planned) in plan.configurations.iter().enumerate() {
        let _ = writeln!(text, "{}:\n  joint_state:", name(index));
        let _ = writeln!(text, "    name: [{}]", names.join(", "));
        let _ = writeln!(text, "    position: {}", numbers(&planned.positions));
        text += "  is_diff: true\n";
    }
    text
}

fn head(what: &str) -> String {
    format!(
        "# eyebolt plan: {what}.\n# Radians, metres for joints that slide. eyebolt moves nothing: look at the way \
         before an arm takes it.\n"
    )
}

/// Six places are a micrometre and more than any encoder tells; an exponent would be text to YAML 1.1.
fn numbers(values: &[f64]) -> String {
    let values = values.iter().map(|value| format!("{value:.6}"));
    format!("[{}]", values.collect::<Vec<_>>().join(", "))
}

/// Names are from outside: as a string of YAML whatever is in them.
fn quoted(name: &str) -> String {
    serde_json::to_string(name).expect("a string")
}
