//! The arm as it really is where the description is wrong.

use super::dress::{add_tool, bounds};
use super::faults::Faults;
use super::random_stream::RandomStream;
use super::scenario::Scenario;
use eyebolt_geometry::{Link, Transform};
use eyebolt_render::Random;
use eyebolt_robot::{Arm, Body, Joint, Robot, Shape};
use nalgebra::{UnitQuaternion, Vector3};

/// The arm of `scenario` as it really is, but for what gives way.
pub(super) fn true_arm(scenario: &Scenario<'_>) -> Arm {
    let mut robot = scenario.arm.robot().clone();
    let Faults { link_length_m, base_lower_m, lab, .. } = scenario.faults;
    if link_length_m != 0.0 {
        lengthen(&mut robot, scenario.arm, link_length_m, RandomStream::Link.of(scenario.seed));
    }
    if base_lower_m != 0.0 {
        lower_base(&mut robot, scenario.arm, base_lower_m);
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

/// Lets the base stand lower below the first joint that turns, by `by_m` along its axis: a plain column
/// fills the gap, thinner than what it stands on.
fn lower_base(robot: &mut Robot, arm: &Arm, by_m: f64) {
    let first = arm.required_joints().first().and_then(|name| robot.joint_index(name));
    let Some(first) = first else { return };
    let Joint { parent, parent_from_child_at_zero: at, axis, .. } = robot.joints[first].clone();
    let along = at.direction(&axis.into_inner());
    let up = if along.dot(&at.translation_m()) < 0.0 { -along } else { along };
    robot.joints[first].parent_from_child_at_zero =
        Transform::<Link, Link>::from_parts(at.translation_m() + by_m * up, at.rotation());
    let Some((low, high)) = bounds(robot, parent).filter(|_| by_m > 0.0) else { return };
    let (size, middle) = (high - low, nalgebra::center(&low, &high).coords);
    let across = (0..3).filter(|side| *side != up.iamax()).map(|side| size[side]);
    let radius = COLUMN * 0.5 * across.fold(f64::INFINITY, f64::min);
    // From the middle of the base to where its top was, about the axis.
    let length = 0.5 * size[up.iamax()] + by_m;
    let (at, middle) = (at.translation_m(), middle.dot(&up));
    let centre = at + up * (middle + 0.5 * length - at.dot(&up));
    let turn = UnitQuaternion::rotation_between(&Vector3::z(), &up).unwrap_or_else(|| {
        UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
    });
    let link_from_body = Transform::from_parts(centre, turn);
    let shape = Shape::Cylinder { radius, length };
    robot.links[parent].visuals.push(Body { link_from_body, shape });
}

/// Of half the base's width.
const COLUMN: f64 = 0.7;
