//! What residuals weigh, and the linear problem they add up to.

use super::evidence::{Evidence, deviations};
use super::{JointPrior, RefineOptions, joint_prior};
use crate::arm::{ArmModel, MOST_JOINTS};
use crate::factors::{DEPTH_SCALE, FIRST_JOINT, Factor, OUTLINE_WIDTH, State, UNKNOWNS};
use crate::normal_equations::NormalEquations;
use crate::robust::geman_mcclure;
use nalgebra::SVector;
use rayon::prelude::*;

/// Errors of depth go together over patches of about this many pixels.
const SURFACE_PATCH_PX: f64 = 400.0;
/// Errors of an outline go together over about this many pixels.
const OUTLINE_PATCH_PX: f64 = 8.0;
/// Prior deviation of the depth's scale.
const DEPTH_SCALE_PRIOR: f64 = 0.01;
/// Prior deviation of the outline's excess, pixels.
const OUTLINE_PRIOR_PX: f64 = 1.0;

/// How much the two kinds of evidence count: as much as their residuals deserve, or one of them
/// hardly at all, to see whether the two agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trust {
    /// Both.
    Both,
    /// Distances from surfaces.
    Surfaces,
    /// Distances from outlines.
    Outlines,
}

/// What remains of a kind of evidence that is not trusted: enough to determine the pose.
const DISTRUSTED: f64 = 0.01;

impl Trust {
    fn in_surfaces(self) -> f64 {
        if self == Self::Outlines { DISTRUSTED } else { 1.0 }
    }

    fn in_outlines(self) -> f64 {
        if self == Self::Surfaces { DISTRUSTED } else { 1.0 }
    }
}

/// Sizes of residuals: robust scales, or deviations.
#[derive(Clone, Copy)]
pub(super) struct Scales {
    pub surface_m: f64,
    pub outline_px: f64,
}

/// An unknown that is `value` away from what it is taken for, give or take `deviation`.
pub(super) struct Prior {
    pub unknown: usize,
    pub value: f64,
    pub deviation: f64,
}

/// How residuals are weighed in one step.
#[derive(Clone, Copy)]
pub(super) struct Weighing {
    pub scales: Scales,
    pub sigma: Scales,
    pub trust: Trust,
    /// Prior deviation of each joint's offset, radians.
    pub joint_prior_rad: [f64; MOST_JOINTS],
    /// The joints of whose offsets the others tell nothing.
    pub apart: [bool; MOST_JOINTS],
}

impl Weighing {
    /// Weighs `evidence` by its own deviations.
    pub fn of(
        arm: &ArmModel,
        evidence: &[Evidence],
        scales: &Scales,
        state: &State,
        options: &RefineOptions,
    ) -> Self {
        let sigma = deviations(evidence, scales);
        let mut weighing = Self {
            scales: *scales,
            sigma,
            trust: options.trust,
            joint_prior_rad: [1.0; MOST_JOINTS],
            apart: std::array::from_fn(|joint| {
                arm.joints().get(joint).is_some_and(|joint| joint.defines_base)
            }),
        };
        weighing.joint_prior_rad = match options.joint_prior {
            JointPrior::Known { rad } => rad,
            JointPrior::Estimated => joint_prior::estimate(evidence, &weighing, state),
        };
        weighing
    }

    /// Which unknowns have a prior, what it takes them to be, and how surely.
    pub fn priors(&self, state: &State) -> impl Iterator<Item = Prior> {
        let others = [
            Prior { unknown: DEPTH_SCALE, value: state.depth_scale, deviation: DEPTH_SCALE_PRIOR },
            Prior { unknown: OUTLINE_WIDTH, value: state.outline_px, deviation: OUTLINE_PRIOR_PX },
        ];
        let joints = state.joint_offsets.rad.into_iter().zip(self.joint_prior_rad).enumerate();
        let of_joint =
            |(joint, (value, deviation))| Prior { unknown: FIRST_JOINT + joint, value, deviation };
        others.into_iter().chain(joints.map(of_joint))
    }

    pub fn surface(&self, evidence: &Evidence, factor: &Factor) -> f64 {
        let patches = (evidence.pixels_per_point / SURFACE_PATCH_PX).min(1.0);
        let robust = geman_mcclure(factor.residual, self.scales.surface_m);
        evidence.share(factor) * self.trust.in_surfaces() * patches * robust
            / self.sigma.surface_m.powi(2)
    }

    pub fn outline(&self, evidence: &Evidence, factor: &Factor) -> f64 {
        let patches = (evidence.cracks_per_factor / OUTLINE_PATCH_PX).min(1.0);
        let robust = geman_mcclure(factor.residual, self.scales.outline_px);
        evidence.share(factor) * self.trust.in_outlines() * patches * robust
            / self.sigma.outline_px.powi(2)
    }

    /// The linearised problem of all views, with the priors. Views are added in their order.
    pub fn total(&self, evidence: &[Evidence], state: &State) -> NormalEquations<UNKNOWNS> {
        let views: Vec<_> = evidence.par_iter().map(|view| self.one_view(view)).collect();
        let mut sum = NormalEquations::default();
        for view in &views {
            sum.add_all(view);
        }
        for prior in self.priors(state) {
            sum.add(&SVector::ith(prior.unknown, 1.0), prior.value, prior.deviation.powi(-2));
        }
        sum
    }

    fn one_view(&self, view: &Evidence) -> NormalEquations<UNKNOWNS> {
        let mut sum = NormalEquations::default();
        for factor in &view.surface {
            sum.add(&factor.jacobian, factor.residual, self.surface(view, factor));
        }
        for factor in &view.outline {
            sum.add(&factor.jacobian, factor.residual, self.outline(view, factor));
        }
        sum
    }
}
