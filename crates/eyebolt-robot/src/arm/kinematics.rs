//! Forward kinematics: joint positions into poses of links.

use super::chain::Arm;
use crate::error::KinematicsError;
use crate::joint_positions::JointPositions;
use crate::robot::{Joint, JointKind, Robot};
use eyebolt_geometry::{Base, EndEffector, Transform, frame};

/// `base_from_link` per link of [`Robot::links`]; `None` where the base does not decide it.
pub type LinkPoses = Vec<Option<Transform<Base, frame::Link>>>;

/// Poses of the links, some of them with positions that nobody recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct PosesWithDefaults {
    /// `base_from_link` per link.
    pub base_from_links: LinkPoses,
    /// Joints below the end-effector that took a default position.
    pub defaulted_joints: Vec<String>,
    /// Joints elsewhere without a position; the links behind them have no pose.
    pub unplaced_joints: Vec<String>,
}

/// Poses of the links that the recorded positions decide.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownPoses {
    /// `base_from_link` per link.
    pub base_from_links: LinkPoses,
    /// Joints without a position; the links behind them have no pose.
    pub unplaced_joints: Vec<String>,
}

impl Arm {
    /// Pose of every link whose place the base decides: links below it, and links that fixed joints
    /// connect to it from above.
    ///
    /// # Errors
    /// [`KinematicsError::MissingArmJoints`] if a joint between base and end-effector has no
    /// position, [`KinematicsError::MissingOtherJoints`] if only joints elsewhere below the base
    /// have none, [`KinematicsError::NotFinite`] if a position that is needed is not a number.
    pub fn link_poses(&self, positions: &JointPositions) -> Result<LinkPoses, KinematicsError> {
        self.check_arm(positions)?;
        let missing = self.missing(self.moving_joints_below_base(), positions);
        if !missing.is_empty() {
            let recorded = recorded(positions);
            return Err(KinematicsError::MissingOtherJoints { missing, recorded });
        }
        Ok(self.place(&self.joint_values(positions)?))
    }

    /// As [`Arm::link_poses`], but joints below the end-effector may be missing: prismatic ones are
    /// put at their lower limit, others at the allowed position nearest to 0. Links behind other
    /// missing joints have no pose.
    ///
    /// # Errors
    /// As [`Arm::link_poses`], without [`KinematicsError::MissingOtherJoints`].
    pub fn link_poses_with_defaults(
        &self,
        positions: &JointPositions,
    ) -> Result<PosesWithDefaults, KinematicsError> {
        self.check_arm(positions)?;
        let below_end_effector = |joint: &usize| {
            let parent = self.robot.joints.get(*joint).map(|joint| joint.parent);
            parent.and_then(|link| self.below_end_effector.get(link).copied()).unwrap_or(false)
        };
        let (hand, elsewhere): (Vec<_>, Vec<_>) =
            self.moving_joints_below_base().partition(below_end_effector);
        let defaulted_joints = self.missing(hand.iter().copied(), positions);
        let mut unplaced_joints = self.missing(elsewhere.into_iter(), positions);
        unplaced_joints.retain(|name| !defaulted_joints.contains(name));
        let defaults: JointPositions = defaulted_joints
            .iter()
            .map(|name| (name.clone(), self.default_position(name)))
            .collect();
        let mut values = self.joint_values(positions)?;
        for joint in hand {
            if let Some(value @ None) = values.get_mut(joint) {
                *value = self.value(joint, &defaults)?;
            }
        }
        let base_from_links = self.place(&values);
        Ok(PosesWithDefaults { base_from_links, defaulted_joints, unplaced_joints })
    }

    /// As [`Arm::link_poses`], but joints outside the chain may be missing: links behind them have no
    /// pose.
    ///
    /// # Errors
    /// As [`Arm::link_poses`], without [`KinematicsError::MissingOtherJoints`].
    pub fn known_link_poses(
        &self,
        positions: &JointPositions,
    ) -> Result<KnownPoses, KinematicsError> {
        self.check_arm(positions)?;
        let unplaced_joints = self.missing(self.moving_joints_below_base(), positions);
        let base_from_links = self.place(&self.joint_values(positions)?);
        Ok(KnownPoses { base_from_links, unplaced_joints })
    }

    /// Pose of the end-effector link; needs only [`Arm::required_joints`].
    ///
    /// # Errors
    /// [`KinematicsError::MissingArmJoints`] or [`KinematicsError::NotFinite`].
    pub fn base_from_end_effector(
        &self,
        positions: &JointPositions,
    ) -> Result<Transform<Base, EndEffector>, KinematicsError> {
        self.check_arm(positions)?;
        let mut base_from_link = nalgebra::Isometry3::identity();
        for index in &self.chain {
            let Some(joint) = self.robot.joints.get(*index) else { continue };
            let position = self.value(*index, positions)?.unwrap_or(0.0);
            base_from_link *= joint.parent_from_child(position).isometry();
        }
        Ok(Transform::from_isometry(base_from_link))
    }

    fn check_arm(&self, positions: &JointPositions) -> Result<(), KinematicsError> {
        let missing = self.missing(self.chain.iter().copied(), positions);
        if missing.is_empty() {
            return Ok(());
        }
        Err(KinematicsError::MissingArmJoints { missing, recorded: recorded(positions) })
    }

    /// Joints that `joints` wait for.
    fn missing(
        &self,
        joints: impl Iterator<Item = usize>,
        positions: &JointPositions,
    ) -> Vec<String> {
        let without = joints.filter(|joint| {
            let moves = self.robot.joints.get(*joint).is_some_and(Joint::moves);
            moves && self.robot.position(*joint, positions).is_none()
        });
        self.sources(without).into_iter().map(str::to_owned).collect()
    }

    /// Where [`Arm::link_poses_with_defaults`] puts joint `name` if it has no position, radians or
    /// metres.
    pub fn default_position(&self, name: &str) -> f64 {
        let joint = self.robot.joints.iter().find(|joint| joint.name == name);
        match joint.map(|joint| (joint.kind, joint.limits)) {
            Some((JointKind::Prismatic, Some(limits))) => limits.lower,
            Some((_, Some(limits))) => limits.lower.max(limits.upper.min(0.0)),
            _ => 0.0,
        }
    }

    fn value(
        &self,
        joint: usize,
        positions: &JointPositions,
    ) -> Result<Option<f64>, KinematicsError> {
        let position = self.robot.position(joint, positions);
        match position.filter(|position| !position.is_finite()) {
            Some(position) => {
                let joint = self.robot.joints.get(joint).map_or("", |joint| &joint.name).to_owned();
                Err(KinematicsError::NotFinite { joint, position })
            }
            None => Ok(position),
        }
    }

    /// Position per joint below the base, `None` where it is not known; 0 for fixed joints.
    fn joint_values(
        &self,
        positions: &JointPositions,
    ) -> Result<Vec<Option<f64>>, KinematicsError> {
        let mut values: Vec<_> =
            self.robot.joints.iter().map(|joint| joint.is_fixed().then_some(0.0)).collect();
        for joint in self.moving_joints_below_base() {
            if let Some(value) = values.get_mut(joint) {
                *value = self.value(joint, positions)?;
            }
        }
        Ok(values)
    }

    /// Poses for a position per joint; joints not below the base count only where fixed.
    fn place(&self, values: &[Option<f64>]) -> LinkPoses {
        let mut poses: LinkPoses = vec![None; self.robot.links.len()];
        let mut link = self.base;
        let mut pose = Transform::<Base, frame::Link>::identity();
        if let Some(place) = poses.get_mut(link) {
            *place = Some(pose);
        }
        // Up from the base, as far as joints are fixed.
        while let Some((parent, joint)) = self.robot.links.get(link).and_then(|link| link.parent) {
            let Some(joint) = self.robot.joints.get(joint).filter(|joint| joint.is_fixed()) else {
                break;
            };
            pose = pose * joint.parent_from_child_at_zero.inverse();
            if let Some(place) = poses.get_mut(parent) {
                *place = Some(pose);
            }
            link = parent;
        }
        // Then down: joints are in the order of their children, so parents are placed first.
        for (joint, value) in self.robot.joints.iter().zip(values) {
            let parent = poses.get(joint.parent).copied().flatten();
            let (Some(parent), Some(value)) = (parent, value) else { continue };
            if let Some(place) = poses.get_mut(joint.child).filter(|place| place.is_none()) {
                *place = Some(parent * joint.parent_from_child(*value));
            }
        }
        poses
    }
}

impl Robot {
    /// Position of `joint`: recorded, or of the joint that it follows. A mimic joint's own record
    /// counts only where nothing that it follows is recorded.
    fn position(&self, joint: usize, positions: &JointPositions) -> Option<f64> {
        let (mut multiplier, mut offset, mut position) = (1.0, 0.0, None);
        let mut joint = self.joints.get(joint)?;
        loop {
            if let Some(recorded) = positions.get(&joint.name) {
                position = Some(multiplier * recorded + offset);
            }
            let Some(mimic) = joint.mimic else { return position };
            offset += multiplier * mimic.offset;
            multiplier *= mimic.multiplier;
            joint = self.joints.get(mimic.joint)?;
        }
    }
}

fn recorded(positions: &JointPositions) -> Vec<String> {
    positions.iter().map(|(name, _)| name.to_owned()).collect()
}
