//! What is estimated along with the pose, and in which order.
//!
//! Translation (m) and rotation vector (rad) of `camera_from_base` as
//! [`Transform::retract`](eyebolt_geometry::Transform::retract) has them, one nuisance parameter for
//! each kind of evidence, the offset of each joint (rad) and of the intrinsics: ARCHITECTURE.md, (2).

use crate::arm::{JointOffsets, MOST_JOINTS};
use crate::intrinsics_offset::{INTRINSICS, IntrinsicsOffset};
use eyebolt_geometry::{Base, Camera, Transform};
use nalgebra::SVector;

/// How many kinds of evidence there are; each has one nuisance parameter.
pub const EVIDENCE_KINDS: usize = 2;
/// Place of the distances from surfaces among the kinds.
pub const SURFACES: usize = 0;
/// Place of the distances from outlines among the kinds.
pub const OUTLINES: usize = 1;

/// Unknowns of the pose; they come first.
pub(crate) const POSE: usize = 6;
/// Place of the first nuisance parameter among the unknowns, in the order of the kinds.
pub(crate) const FIRST_NUISANCE: usize = POSE;
/// Place of the first joint's offset among the unknowns.
pub(crate) const FIRST_JOINT: usize = FIRST_NUISANCE + EVIDENCE_KINDS;
/// Place of the first number of the intrinsics' offset among the unknowns.
pub(crate) const FIRST_INTRINSIC: usize = FIRST_JOINT + MOST_JOINTS;
/// Offsets of joints and intrinsics: what the recording says, and may be wrong.
pub(crate) const OFFSETS: usize = MOST_JOINTS + INTRINSICS;
/// Number of unknowns.
pub(crate) const UNKNOWNS: usize = FIRST_INTRINSIC + INTRINSICS;

/// A value for each unknown, or a derivative by each.
pub(crate) type Unknowns = SVector<f64, UNKNOWNS>;

/// What the unknowns are now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct State {
    pub camera_from_base: Transform<Camera, Base>,
    /// In the order of the kinds of evidence, each in its kind's unit.
    pub nuisances: [f64; EVIDENCE_KINDS],
    pub joint_offsets: JointOffsets,
    pub intrinsics: IntrinsicsOffset,
}

impl State {
    /// Offsets of the joints, then of the intrinsics.
    pub fn offsets(&self) -> [f64; OFFSETS] {
        let intrinsics = self.intrinsics.numbers();
        std::array::from_fn(|i| match i.checked_sub(MOST_JOINTS) {
            None => self.joint_offsets.rad[i],
            Some(i) => intrinsics[i],
        })
    }

    pub fn stepped(&self, step: &Unknowns) -> Self {
        let joints = step.fixed_rows::<MOST_JOINTS>(FIRST_JOINT);
        let rad = std::array::from_fn(|joint| self.joint_offsets.rad[joint] + joints[joint]);
        let numbers = self.intrinsics.numbers();
        let intrinsics = std::array::from_fn(|i| numbers[i] + step[FIRST_INTRINSIC + i]);
        Self {
            camera_from_base: self.camera_from_base.retract(&step.fixed_rows::<6>(0).into_owned()),
            nuisances: std::array::from_fn(|kind| {
                self.nuisances[kind] + step[FIRST_NUISANCE + kind]
            }),
            joint_offsets: JointOffsets { rad },
            intrinsics: IntrinsicsOffset::from_numbers(intrinsics),
        }
    }
}
