//! What joints say of where they are.

use super::faults::Faults;
use eyebolt_geometry::{Base, Transform};
use eyebolt_render::Random;
use eyebolt_robot::{Arm, JointKind, JointPositions};
use std::collections::BTreeMap;

/// What the joints of one robot say of where they are.
#[derive(Clone, Debug)]
pub(super) struct Encoders {
    offsets: BTreeMap<String, f64>,
    backlash: f64,
}

impl Encoders {
    pub(super) fn new(arm: &Arm, faults: &Faults, random: &mut Random) -> Self {
        let robot = arm.robot();
        let turns = |name: &&str| {
            robot.joint_index(name).is_some_and(|index| {
                matches!(robot.joints[index].kind, JointKind::Revolute | JointKind::Continuous)
            })
        };
        let joints: Vec<&str> = arm.required_joints().into_iter().filter(turns).collect();
        let mut sign = || if random.uniform() < 0.5 { -1.0 } else { 1.0 };
        let equal: Vec<f64> = joints.iter().map(|_| sign() * faults.joint_offset).collect();
        let offset = |equal: f64| equal + faults.joint_offset_sigma * random.normal();
        let mut offsets: Vec<f64> = equal.into_iter().map(offset).collect();
        // That of the first joint cannot be told from a turned base.
        let one = 1 + random.index(offsets.len().saturating_sub(1));
        let sign = if random.uniform() < 0.5 { -1.0 } else { 1.0 };
        if let Some(offset) = offsets.get_mut(one) {
            *offset += sign * faults.one_joint_offset;
        }
        let offsets = joints.into_iter().map(str::to_owned).zip(offsets).collect();
        Self { offsets, backlash: faults.backlash }
    }

    /// How much farther each joint stands than it says, radians.
    pub(super) fn offsets(&self) -> BTreeMap<String, f64> {
        self.offsets.iter().map(|(name, told)| (name.clone(), -told)).collect()
    }

    /// From the base as the first joint's word has it, in which its links are where it says, to the
    /// base link.
    pub(super) fn base_from_told_base(&self, arm: &Arm) -> Transform<Base, Base> {
        let none = Transform::identity();
        let names = arm.required_joints();
        let Some((first, offset)) =
            names.first().and_then(|name| self.offsets.get_key_value(*name))
        else {
            return none;
        };
        let robot = arm.robot();
        let Some(index) = robot.joint_index(first) else { return none };
        let child_at = |position: f64| {
            let at =
                |name: &&str| ((*name).to_owned(), if *name == first { position } else { 0.0 });
            let poses = arm.link_poses_with_defaults(&names.iter().map(at).collect()).ok()?;
            poses.base_from_links.get(robot.joints[index].child).copied().flatten()
        };
        let turned = child_at(-offset).zip(child_at(0.0));
        turned.map_or(none, |(told, zero)| told * zero.inverse())
    }

    /// What they say at `joints`, on the way from `before` to `target` or at rest there: the gear
    /// lies at the side that it was pushed to. In the first configuration it is in the middle.
    pub(super) fn read(
        &self,
        joints: &JointPositions,
        before: Option<&JointPositions>,
        target: &JointPositions,
    ) -> JointPositions {
        let told = joints.iter().map(|(name, position)| {
            let Some(offset) = self.offsets.get(name) else {
                return (name.to_owned(), position);
            };
            let start = before.and_then(|before| before.get(name));
            let way = start.zip(target.get(name)).map_or(0.0, |(start, end)| end - start);
            let side = if way == 0.0 { 0.0 } else { way.signum() };
            (name.to_owned(), position + offset + 0.5 * self.backlash * side)
        });
        told.collect()
    }
}
