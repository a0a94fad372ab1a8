//! What a refinement comes to.

use super::doubts::Doubt;
use super::left_out::LeftOut;
use super::start::{OffsetDeviations, Start};
use crate::arm::{JointOffsets, MOST_JOINTS};
use crate::intrinsics_offset::IntrinsicsOffset;
use crate::unknowns::{EVIDENCE_KINDS, OUTLINES, SURFACES};
use eyebolt_geometry::{Base, Camera, Transform};
use nalgebra::{Matrix6, Vector6};

/// Why a refinement stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopReason {
    /// The last step was negligible.
    Converged,
    /// It was still moving after as many steps as allowed.
    IterationLimit,
    /// The evidence does not determine the pose.
    Underdetermined,
}

/// How well one kind of evidence fits in one view.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fit {
    /// Median size of the residuals, in the kind's unit; `None` if there are none.
    pub median: Option<f64>,
    /// Residuals within three standard deviations.
    pub inliers: usize,
}

/// How well one view fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewFit {
    /// By kind of evidence.
    pub fits: [Fit; EVIDENCE_KINDS],
    /// Points of the arm that there were.
    pub points: usize,
}

impl ViewFit {
    /// Median distance of the arm's points from the posed surface, metres; `None` without points.
    pub fn surface_m(&self) -> Option<f64> {
        self.fits[SURFACES].median
    }

    /// Median distance of the posed contour from the outline seen, pixels; `None` if no outline was
    /// seen.
    pub fn outline_px(&self) -> Option<f64> {
        self.fits[OUTLINES].median
    }
}

/// Outcome of a refinement.
#[derive(Clone, Debug, PartialEq)]
pub struct Refinement {
    /// The pose.
    pub camera_from_base: Transform<Camera, Base>,
    /// How much farther the joints stand than they say, as far as the data tell.
    pub joint_offsets: JointOffsets,
    /// Root mean square error of each of them, radians: its marginal standard deviation under a prior
    /// that is wide open, and how far it is from where the evidence has it under that prior; infinite
    /// where nothing is determined.
    pub joint_sigma_rad: [f64; MOST_JOINTS],
    /// How far the true intrinsics are from those stated, as far as the data tell.
    pub intrinsics: IntrinsicsOffset,
    /// Standard deviations of the priors of the joints' and the intrinsics' offsets that this came with.
    pub offset_prior: OffsetDeviations,
    /// The nuisance parameter of each kind of evidence.
    pub nuisances: [f64; EVIDENCE_KINDS],
    /// Lengths and intrinsics that were taken at their word although the data may tell otherwise.
    pub doubts: Vec<Doubt>,
    /// Information of translation (m) and rotation (rad), the other unknowns marginalised, as
    /// weighted in the last step.
    pub information: Matrix6<f64>,
    /// Covariance of the same, from how the evidence of separate clusters disagrees (sandwich).
    pub covariance: Matrix6<f64>,
    /// Standard deviation of the residuals of each kind of evidence, in its unit.
    pub deviations: [f64; EVIDENCE_KINDS],
    /// One for each view.
    pub views: Vec<ViewFit>,
    /// For each view the answer without it; empty where the rest does not determine one.
    pub left_out: Vec<LeftOut>,
    /// Of more than ten views, the answers without each of ten groups of them.
    pub groups_left_out: Vec<LeftOut>,
    /// Steps taken.
    pub iterations: usize,
    /// The last of them: translation (m) and rotation (rad).
    pub last_step: Vector6<f64>,
    /// Why it stopped.
    pub stop: StopReason,
}

impl Refinement {
    /// From where another refinement would go on.
    pub fn end(&self) -> Start {
        let Self { camera_from_base, joint_offsets, nuisances, intrinsics, .. } = *self;
        Start { camera_from_base, joint_offsets, nuisances, intrinsics }
    }

    /// Relative error of the depth's scale: true depth is `1 + this` times the depth seen.
    pub fn depth_scale(&self) -> f64 {
        self.nuisances[SURFACES]
    }

    /// By how many pixels the outline seen is wider than the arm.
    pub fn outline_px(&self) -> f64 {
        self.nuisances[OUTLINES]
    }
}
