//! What goes wrong in laboratories, on purpose.

use super::lab::Lab;
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_render::{IntrinsicsError, Random};
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
    /// How far one joint, which is not the first, is from where it says besides, one way or the other,
    /// radians. Which one the seed decides.
    pub one_joint_offset: f64,
    /// How much longer one link is than the description says, metres. Which one the seed decides.
    pub link_length_m: f64,
    /// How much lower the part that the first joint stands on is than the description says, metres: the
    /// base of another variant, its column longer or shorter.
    pub base_lower_m: f64,
    /// Whether only the last joints move, so that all configurations are alike.
    pub wrist_only: bool,
    /// Share of the arm that a box before it hides, in all configurations together.
    pub occlusion: f64,
    /// The camera moves after half of the configurations: how far, metres and radians.
    pub bump: Option<[f64; 2]>,
    /// What is there besides.
    pub lab: Lab,
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
            one_joint_offset: 0.0,
            link_length_m: 0.0,
            base_lower_m: 0.0,
            wrist_only: false,
            occlusion: 0.0,
            bump: None,
            lab: Lab::default(),
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
            ("one_joint_offset_deg", self.one_joint_offset.to_degrees(), 0.0),
            ("link_length_mm", 1e3 * self.link_length_m, 0.0),
            ("base_lower_mm", 1e3 * self.base_lower_m, 0.0),
            ("wrist_only", f64::from(u8::from(self.wrist_only)), 0.0),
            ("occlusion", self.occlusion, 0.0),
            ("bump_mm", 1e3 * bump_m, 0.0),
            ("bump_deg", bump_rad.to_degrees(), 0.0),
        ];
        let there = rows.into_iter().filter(|(_, value, none)| value != none);
        let there = there.map(|(name, value, _)| (name.to_owned(), value.into()));
        there.chain(self.lab.named()).collect()
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
