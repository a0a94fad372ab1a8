//! What is estimated along with the pose, and in which order.
//!
//! Translation (m) and rotation vector (rad) of `camera_from_base` as
//! [`Transform::retract`](eyebolt_geometry::Transform::retract) has them, one nuisance parameter for
//! each kind of evidence, the offset of each joint (rad), of the lengths before
//! them (m) and of the intrinsics: ARCHITECTURE.md, (2).

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
/// Place of the first link's length among the unknowns.
pub(crate) const FIRST_LENGTH: usize = FIRST_JOINT + MOST_JOINTS;
/// Place of the first number of the intrinsics' offset among the unknowns.
pub(crate) const FIRST_INTRINSIC: usize = FIRST_LENGTH + MOST_JOINTS;
/// Offsets of joints, lengths and intrinsics: what recording and description say, and may be wrong.
pub(crate) const OFFSETS: usize = 2 * MOST_JOINTS + INTRINSICS;
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
    /// Offsets of the joints, the lengths, then the intrinsics.
    pub fn offsets(&self) -> [f64; OFFSETS] {
        let JointOffsets { rad, lengths_m } = self.joint_offsets;
        let intrinsics = self.intrinsics.numbers();
        let mut all = rad.into_iter().chain(lengths_m).chain(intrinsics);
        std::array::from_fn(|_| all.next().unwrap_or_default())
    }

    pub fn stepped(&self, step: &Unknowns) -> Self {
        let joints = step.fixed_rows::<MOST_JOINTS>(FIRST_JOINT);
        let lengths = step.fixed_rows::<MOST_JOINTS>(FIRST_LENGTH);
        let rad = std::array::from_fn(|joint| self.joint_offsets.rad[joint] + joints[joint]);
        let lengths_m =
            std::array::from_fn(|joint| self.joint_offsets.lengths_m[joint] + lengths[joint]);
        let numbers = self.intrinsics.numbers();
        let intrinsics = std::array::from_fn(|i| numbers[i] + step[FIRST_INTRINSIC + i]);
        Self {
            camera_from_base: self.camera_from_base.retract(&step.fixed_rows::<6>(0).into_owned()),
            nuisances: std::array::from_fn(|kind| {
                self.nuisances[kind] + step[FIRST_NUISANCE + kind]
            }),
            joint_offsets: JointOffsets { rad, lengths_m },
            intrinsics: IntrinsicsOffset::from_numbers(intrinsics),
        }
    }
}
