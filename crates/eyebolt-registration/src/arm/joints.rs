//! Joints whose zero may be off: where they put the links if it is.

use super::{ArmModel, Posture};
use eyebolt_geometry::{Base, Link, Transform};
use nalgebra::{Isometry3, Point3, Translation3, Unit, UnitQuaternion, Vector3};

/// Joints of one arm whose zeros can be looked for: one more than a redundant arm has.
pub const MOST_JOINTS: usize = 8;

/// A turning joint on the way from the base to the end-effector.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ArmJoint {
    /// The joint's name in the URDF.
    pub name: String,
    /// Which links of the [`ArmModel`] it carries, one entry for each of them.
    pub carries: Vec<bool>,
    /// Whether its zero is part of what the base frame is: that of the first joint, which nothing
    /// but a view of the base link itself tells from a turned base. The base frame is then the one
    /// that the joint's own word refers to, and if its zero is off it is the links that the joint
    /// does not carry that stand elsewhere, turned the other way.
    pub defines_base: bool,
}

impl ArmJoint {
    /// By how much a link turns about the joint's axis for each radian that the joint is off.
    pub(crate) fn turns(&self, link: usize) -> f64 {
        match (self.carries[link], self.defines_base) {
            (true, false) => 1.0,
            (false, true) => -1.0,
            _ => 0.0,
        }
    }
}

/// Where a joint's axis is while the arm is in one configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointAxis {
    /// A point on it, base frame, metres.
    pub through_in_base: Point3<f64>,
    /// Its direction, base frame.
    pub along_in_base: Unit<Vector3<f64>>,
}

/// How much farther each joint of an [`ArmModel`] stands than it says, radians; zero beyond its
/// last joint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointOffsets {
    /// In the order of [`ArmModel::joints`].
    pub rad: [f64; MOST_JOINTS],
}

impl JointAxis {
    /// Turns whatever hangs on the joint further by `angle` radians.
    fn turn(&self, angle: f64) -> Isometry3<f64> {
        let rotation = UnitQuaternion::from_axis_angle(&self.along_in_base, angle);
        let through = self.through_in_base.coords;
        Isometry3::from_parts(Translation3::from(through - rotation * through), rotation)
    }

    /// Derivative of `gradient . point` by the angle of a joint that carries the point; both in the
    /// base frame.
    pub(crate) fn derivative(&self, gradient: &Vector3<f64>, point: &Point3<f64>) -> f64 {
        self.along_in_base.dot(&(point - self.through_in_base).cross(gradient))
    }
}

impl Posture {
    /// The same arm with its joints farther by `offsets`.
    ///
    /// By the product of exponentials (Brockett, Robotic manipulators and the product of
    /// exponentials formula, 1984): each joint turns what it carries about the axis that it has in
    /// this posture, the last joint first. The one that defines the base turns what stands before it.
    #[must_use]
    pub fn moved(&self, arm: &ArmModel, offsets: &JointOffsets) -> Self {
        let (mut poses, mut axes) = (self.base_from_link.clone(), self.axes.clone());
        for (index, joint) in arm.joints.iter().enumerate().take(self.axes.len()).rev() {
            let angle = offsets.rad[index];
            for (link, pose) in poses.iter_mut().enumerate() {
                let turn = self.axes[index].turn(joint.turns(link) * angle);
                *pose = Transform::<Base, Link>::from_isometry(turn * pose.isometry());
            }
            let turn = self.axes[index].turn(if joint.defines_base { 0.0 } else { angle });
            for axis in &mut axes[index + 1..] {
                axis.through_in_base = turn * axis.through_in_base;
                axis.along_in_base = turn.rotation * axis.along_in_base;
            }
        }
        Self::new(arm, poses).with_axes(axes)
    }

    /// The joints with their axes and their place among the arm's joints.
    pub(crate) fn joints_with_axes<'a>(
        &'a self,
        arm: &'a ArmModel,
    ) -> impl Iterator<Item = (usize, &'a ArmJoint, &'a JointAxis)> {
        let joints = arm.joints.iter().zip(&self.axes).enumerate();
        joints.map(|(place, (joint, axis))| (place, joint, axis))
    }

    /// How far a point that every joint carries moves if the joints stand farther by `offsets`, to
    /// first order; base frame, metres.
    pub fn moved_by(
        &self,
        arm: &ArmModel,
        offsets: &JointOffsets,
        point_in_base: &Point3<f64>,
    ) -> Vector3<f64> {
        let joints = self.joints_with_axes(arm).filter(|(_, joint, _)| !joint.defines_base);
        let moves = joints.map(|(place, _, axis)| {
            let lever = point_in_base - axis.through_in_base;
            offsets.rad[place] * axis.along_in_base.cross(&lever)
        });
        moves.sum()
    }
}
