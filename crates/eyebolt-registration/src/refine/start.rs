//! Where a refinement begins, and how it goes about it.

use crate::arm::{JointOffsets, MOST_JOINTS};
use crate::evidence::Reach;
use crate::intrinsics_offset::{INTRINSICS, IntrinsicsOffset};
use crate::silhouette::Silhouette;
use crate::unknowns::{EVIDENCE_KINDS, OFFSETS, SURFACES, State};
use crate::view::View;
use eyebolt_geometry::{Base, Camera, Transform};
use nalgebra::Point3;

/// One configuration in the refinement.
#[derive(Clone, Debug)]
pub struct RefineView<'a> {
    /// What was seen, and the arm's configuration.
    pub view: View<'a>,
    /// Points well inside the arm's outline: camera frame, metres.
    pub arm_points: Vec<Point3<f32>>,
    /// How many pixels each of them stands for.
    pub pixels_per_point: f64,
    /// The arm's outline, where it is known.
    pub silhouette: Silhouette,
}

/// How to refine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RefineOptions {
    /// Steps at most.
    pub iterations: usize,
    /// How far off the start may be: the robust kernels begin as wide as that takes.
    pub reach: Reach,
    /// Which kinds of evidence count.
    pub trust: Trust,
    /// How far off joints and intrinsics may be.
    pub offset_prior: OffsetPrior,
    /// Whether to say in the end what would be without single views, and what remains in doubt.
    pub in_full: bool,
}

/// Which kinds of evidence count: all as much as their residuals deserve, or all but one hardly at
/// all, to see whether the kinds agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trust {
    /// All of them.
    All,
    /// That of this place among the kinds.
    Only(usize),
}

/// Standard deviations of the priors of what the recording says and may be wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OffsetDeviations {
    /// Of each joint's offset, radians.
    pub joints_rad: [f64; MOST_JOINTS],
    /// Of how much longer than described the link before each joint is, metres.
    pub lengths_m: [f64; MOST_JOINTS],
    /// Of the relative error of the focal lengths and of where the principal point is, in focal lengths.
    pub intrinsics: [f64; INTRINSICS],
}

/// What is known beforehand of how far off joints and intrinsics are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OffsetPrior {
    /// Each by this standard deviation.
    Known(OffsetDeviations),
    /// Joints all by the same deviation, which the data tell, but for those that stand out; intrinsics
    /// hardly, unless they stand out (empirical Bayes).
    Estimated,
}

impl OffsetDeviations {
    /// All as good as zero: what the recording says is taken at its word.
    pub const NONE: Self = Self {
        joints_rad: [1e-5; MOST_JOINTS],
        lengths_m: [1e-6; MOST_JOINTS],
        intrinsics: [1e-6; INTRINSICS],
    };

    /// Of each offset, in the order of the unknowns.
    pub(crate) fn numbers(&self) -> [f64; OFFSETS] {
        let Self { joints_rad, lengths_m, intrinsics } = *self;
        let mut all = joints_rad.into_iter().chain(lengths_m).chain(intrinsics);
        std::array::from_fn(|_| all.next().expect("as many deviations as offsets"))
    }

    pub(crate) fn from_fn(mut deviation: impl FnMut(usize) -> f64) -> Self {
        Self {
            joints_rad: std::array::from_fn(&mut deviation),
            lengths_m: std::array::from_fn(|i| deviation(MOST_JOINTS + i)),
            intrinsics: std::array::from_fn(|i| deviation(2 * MOST_JOINTS + i)),
        }
    }
}

/// Where a refinement begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// The pose.
    pub camera_from_base: Transform<Camera, Base>,
    /// How much farther the joints stand than they say.
    pub joint_offsets: JointOffsets,
    /// The nuisance parameter of each kind of evidence, in its unit.
    pub nuisances: [f64; EVIDENCE_KINDS],
    /// How far the true intrinsics are from those stated.
    pub intrinsics: IntrinsicsOffset,
}

impl Start {
    /// What depth seen has to be multiplied by to be true depth, as far as is known.
    pub fn depth_factor(&self) -> f32 {
        (1.0 + self.nuisances[SURFACES]) as f32
    }
}

impl From<State> for Start {
    fn from(state: State) -> Self {
        let State { camera_from_base, nuisances, joint_offsets, intrinsics } = state;
        Self { camera_from_base, joint_offsets, nuisances, intrinsics }
    }
}

impl From<Start> for State {
    fn from(start: Start) -> Self {
        let Start { camera_from_base, joint_offsets, nuisances, intrinsics } = start;
        Self { camera_from_base, nuisances, joint_offsets, intrinsics }
    }
}

impl From<Transform<Camera, Base>> for Start {
    /// At a pose, with every joint where it says and nothing else known to be off.
    fn from(camera_from_base: Transform<Camera, Base>) -> Self {
        let (joint_offsets, intrinsics) = (JointOffsets::default(), IntrinsicsOffset::default());
        Self { camera_from_base, joint_offsets, nuisances: [0.0; EVIDENCE_KINDS], intrinsics }
    }
}
