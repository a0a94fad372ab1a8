//! The joints whose zeros may be off, and where their axes are.

use eyebolt_registration::{ArmJoint, ArmModel, JointAxis};
use eyebolt_robot::{Arm, JointKind, LinkPoses, Robot};
use nalgebra::Point3;

/// `model`, whose links are `links` of the robot, with those joints that turn between the base and
/// the end-effector; also returns which joints of the robot these are.
///
/// Joints that follow others take no part, nor do those that are followed: their zeros are not one
/// number.
pub(crate) fn offered(arm: &Arm, links: &[usize], model: ArmModel) -> (Vec<usize>, ArmModel) {
    let robot = arm.robot();
    let followed = |index: usize| {
        robot.joints.iter().any(|joint| joint.mimic.is_some_and(|mimic| mimic.joint == index))
    };
    let turns = |kind| matches!(kind, JointKind::Revolute | JointKind::Continuous);
    let mut indices = Vec::new();
    let mut joints = Vec::new();
    for (place, name) in arm.required_joints().into_iter().enumerate() {
        let Some(index) = robot.joint_index(name) else { continue };
        let Some(joint) = robot.joints.get(index) else { continue };
        if !turns(joint.kind) || joint.mimic.is_some() || followed(index) {
            continue;
        }
        let carries = links.iter().map(|link| carries(robot, index, *link)).collect();
        indices.push(index);
        joints.push(ArmJoint { name: name.to_owned(), carries, defines_base: place == 0 });
    }
    (indices, model.with_joints(joints))
}

/// Whether `link` hangs on `joint`.
fn carries(robot: &Robot, joint: usize, link: usize) -> bool {
    let above = |link: usize| robot.links.get(link)?.parent;
    std::iter::successors(above(link), |(parent, _)| above(*parent)).any(|(_, way)| way == joint)
}

/// The axes of `joints` where the links are at `base_from_links`.
pub(super) fn axes(arm: &Arm, joints: &[usize], base_from_links: &LinkPoses) -> Vec<JointAxis> {
    let axis = |index: &usize| {
        let joint = arm.robot().joints.get(*index)?;
        let base_from_child = base_from_links.get(joint.child).copied().flatten()?;
        Some(JointAxis {
            through_in_base: base_from_child.point(&Point3::origin()),
            along_in_base: base_from_child.rotation() * joint.axis,
        })
    };
    joints.iter().map_while(axis).collect()
}
