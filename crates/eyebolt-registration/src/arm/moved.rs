//! Where joint offsets put the links of a posture.

use super::model::{ArmJoint, ArmModel};
use super::offsets::{JointAxis, JointOffsets};
use super::posture::Posture;
use eyebolt_geometry::{Base, Link, Transform};
use nalgebra::{Point3, Translation3, Vector3};

impl Posture {
    /// The same arm with its joints farther, and its links longer, by `offsets`.
    ///
    /// By the product of exponentials (Brockett, Robotic manipulators and the product of
    /// exponentials formula, 1984): each joint turns what it carries about the axis that it has in
    /// this posture, the last joint first. The one that defines the base turns what stands before it.
    #[must_use]
    pub fn moved(&self, arm: &ArmModel, offsets: &JointOffsets) -> Self {
        let (mut poses, mut axes) = (self.base_from_link().to_vec(), self.axes().to_vec());
        for (index, joint) in arm.joints().iter().enumerate().take(axes.len()).rev() {
            let angle = offsets.rad[index];
            let shift = Translation3::from(offsets.lengths_m[index] * self.lengthenings()[index]);
            for (link, pose) in poses.iter_mut().enumerate() {
                let turn = self.axes()[index].turn(joint.turns(link) * angle);
                let shift = if joint.carries[link] { shift } else { Translation3::identity() };
                *pose = Transform::<Base, Link>::from_isometry(shift * turn * pose.isometry());
            }
            let turn =
                shift * self.axes()[index].turn(if joint.defines_base { 0.0 } else { angle });
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
        let joints = arm.joints().iter().zip(self.axes()).enumerate();
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
