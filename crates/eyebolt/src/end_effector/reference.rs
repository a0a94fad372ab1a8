//! Where the fingers are while shapes are looked at.

use eyebolt_geometry::{EndEffector, Link, Transform};
use eyebolt_robot::{Arm, JointPositions, KinematicsError};

/// Every joint of the arm half-way between its limits, so that fingers are apart and no finger hides
/// another; 0 without limits.
pub(super) fn half_open(arm: &Arm) -> JointPositions {
    let half = |name: &str| {
        let joints = &arm.robot().joints;
        let limits = joints.iter().find(|joint| joint.name == name).and_then(|joint| joint.limits);
        (name.to_owned(), limits.map_or(0.0, |limits| 0.5 * (limits.lower + limits.upper)))
    };
    arm.required_joints().into_iter().chain(arm.other_joints()).map(half).collect()
}

/// Poses of `links` in the end-effector frame. Where the arm is does not matter, so that joints of
/// the arm may be missing.
pub(super) fn end_effector_from_links(
    arm: &Arm,
    links: &[usize],
    joints: &JointPositions,
) -> Result<Vec<Transform<EndEffector, Link>>, KinematicsError> {
    let of_arm = arm.required_joints().into_iter().map(|name| (name.to_owned(), 0.0));
    let told = joints.iter().map(|(name, position)| (name.to_owned(), position));
    let joints: JointPositions = of_arm.chain(told).collect();
    let poses = arm.link_poses_with_defaults(&joints)?.base_from_links;
    let end_effector_from_base = arm.base_from_end_effector(&joints)?.inverse();
    let pose = |link: &usize| poses.get(*link).copied().flatten();
    let placed = links.iter().map(|link| pose(link).map(|pose| end_effector_from_base * pose));
    Ok(placed.collect::<Option<_>>().expect("the base decides every link below the end-effector"))
}
