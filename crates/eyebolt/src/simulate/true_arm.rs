//! The arm as it really is where the description is wrong.

use super::dress::add_tool;
use super::faults::Faults;
use super::random_stream::RandomStream;
use super::scenario::Scenario;
use eyebolt_geometry::{Link, Transform};
use eyebolt_render::Random;
use eyebolt_robot::{Arm, Robot};

/// The arm of `scenario` as it really is, but for what gives way.
pub(super) fn true_arm(scenario: &Scenario<'_>) -> Arm {
    let mut robot = scenario.arm.robot().clone();
    let Faults { link_length_m, lab, .. } = scenario.faults;
    if link_length_m != 0.0 {
        lengthen(&mut robot, scenario.arm, link_length_m, RandomStream::Link.of(scenario.seed));
    }
    if lab.tool_m > 0.0 {
        add_tool(&mut robot, scenario.arm.end_effector(), lab.tool_m);
    }
    let (base, end_effector) = (scenario.arm.base_name(), scenario.arm.end_effector_name());
    robot.arm(Some(base), Some(end_effector)).expect("its links are those of the arm described")
}

/// A joint nearer than this to the one before it is of the same housing, metres.
const LONG_M: f64 = 0.05;

/// Makes one link longer by `by_m`: the next joint stands as much farther away. A link that no joint
/// moves is none of them: a longer one is a base that stands elsewhere.
fn lengthen(robot: &mut Robot, arm: &Arm, by_m: f64, mut random: Random) {
    let joints = arm.required_joints();
    let later = joints.iter().skip(1).filter_map(|name| robot.joint_index(name));
    let mut later: Vec<(f64, usize)> = later
        .map(|joint| (robot.joints[joint].parent_from_child_at_zero.translation_m().norm(), joint))
        .collect();
    later.sort_by(|a, b| b.0.total_cmp(&a.0));
    let long = later.iter().filter(|(length_m, _)| *length_m > LONG_M).count();
    let Some((length_m, joint)) = later.get(random.index(long)) else { return };
    let at = robot.joints[*joint].parent_from_child_at_zero;
    let farther = at.translation_m() * (1.0 + by_m / length_m.max(1e-3));
    robot.joints[*joint].parent_from_child_at_zero =
        Transform::<Link, Link>::from_parts(farther, at.rotation());
}
