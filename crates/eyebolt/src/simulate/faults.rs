//! What goes wrong in laboratories, on purpose.

use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_render::{IntrinsicsError, Random};
use eyebolt_robot::{Arm, JointKind, JointPositions};
use nalgebra::{UnitQuaternion, Vector3};
use std::collections::BTreeMap;

/// What a recording gets wrong. The default is nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Faults {
    /// Factor of all depth.
    pub depth_scale: f64,
    /// Added to all depth, metres.
    pub depth_offset_m: f64,
    /// Factor of the focal lengths that the recording states.
    pub focal_scale: f64,
    /// Added to the principal point that the recording states, pixels.
    pub centre_px: [f64; 2],
    /// How far each joint that turns is from where it says, one way or the other, radians.
    pub joint_offset: f64,
    /// Standard deviation of what is added to that, another for each joint, radians.
    pub joint_offset_sigma: f64,
    /// Play of the joints that turn, from one side to the other, radians: they lag by half of it.
    pub backlash: f64,
    /// Added to the stamps of depth, seconds.
    pub time_skew_s: f64,
    /// The camera moves after half of the configurations: how far, metres and radians.
    pub bump: Option<[f64; 2]>,
}

impl Default for Faults {
    fn default() -> Self {
        Self {
            depth_scale: 1.0,
            depth_offset_m: 0.0,
            focal_scale: 1.0,
            centre_px: [0.0; 2],
            joint_offset: 0.0,
            joint_offset_sigma: 0.0,
            backlash: 0.0,
            time_skew_s: 0.0,
            bump: None,
        }
    }
}

impl Faults {
    /// Those that are there, by name, with units in the names.
    pub fn named(&self) -> BTreeMap<String, serde_json::Value> {
        let none = Self::default();
        let [bump_m, bump_rad] = self.bump.unwrap_or_default();
        let rows = [
            ("depth_scale", self.depth_scale, none.depth_scale),
            ("depth_offset_mm", 1e3 * self.depth_offset_m, 0.0),
            ("focal_scale", self.focal_scale, none.focal_scale),
            ("centre_x_px", self.centre_px[0], 0.0),
            ("centre_y_px", self.centre_px[1], 0.0),
            ("joint_offset_deg", self.joint_offset.to_degrees(), 0.0),
            ("joint_offset_sigma_deg", self.joint_offset_sigma.to_degrees(), 0.0),
            ("backlash_deg", self.backlash.to_degrees(), 0.0),
            ("time_skew_ms", 1e3 * self.time_skew_s, 0.0),
            ("bump_mm", 1e3 * bump_m, 0.0),
            ("bump_deg", bump_rad.to_degrees(), 0.0),
        ];
        let there = rows.into_iter().filter(|(_, value, none)| value != none);
        there.map(|(name, value, _)| (name.to_owned(), value.into())).collect()
    }

    /// How the recording states the intrinsics.
    pub(super) fn intrinsics(&self) -> IntrinsicsError {
        IntrinsicsError { focal_scale: [self.focal_scale; 2], centre_px: self.centre_px }
    }

    /// The camera's pose after it was bumped, if it is.
    pub(super) fn bumped(
        &self,
        base_from_camera: &Transform<Base, Camera>,
        random: &mut Random,
    ) -> Option<Transform<Base, Camera>> {
        let [translation_m, rotation] = self.bump?;
        let moved = Transform::from_parts(
            translation_m * direction(random),
            UnitQuaternion::new(rotation * direction(random)),
        );
        Some(*base_from_camera * moved)
    }
}

fn direction(random: &mut Random) -> Vector3<f64> {
    let drawn = Vector3::from_fn(|_, _| random.normal());
    drawn.try_normalize(1e-9).unwrap_or_else(Vector3::x)
}

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
        let offsets = equal.into_iter().map(offset);
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
