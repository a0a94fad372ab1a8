//! Where one frame's joints put the links of a model.

use super::joints;
use eyebolt_registration::{ArmModel, Posture};
use eyebolt_robot::{Arm, JointPositions, KinematicsError};

/// Where `joints` put the links of `model`, which was made of `arm`; `None` if one of them hangs on a
/// joint that has no position here.
pub(crate) fn posture(
    arm: &Arm,
    model: &ArmModel,
    joints: &JointPositions,
) -> Result<Option<Posture>, KinematicsError> {
    let poses = arm.known_link_poses(joints)?.base_from_links;
    let robot = arm.robot();
    let pose = |name: &str| poses.get(robot.link_index(name)?).copied().flatten();
    let base_from_links: Option<Vec<_>> =
        model.links().iter().map(|link| pose(&link.name)).collect();
    let turning: Vec<usize> =
        model.joints().iter().filter_map(|joint| robot.joint_index(&joint.name)).collect();
    let axes = joints::axes(arm, &turning, &poses);
    Ok(base_from_links.map(|links| Posture::new(model, links).with_axes(axes)))
}
