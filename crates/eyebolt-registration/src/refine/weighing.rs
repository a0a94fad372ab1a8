//! What residuals weigh, and the linear problem they add up to.

use super::evidence::{Evidence, deviations};
use crate::factors::{DEPTH_SCALE, Factor, OUTLINE_WIDTH, State, UNKNOWNS};
use crate::normal_equations::NormalEquations;
use crate::robust::geman_mcclure;
use nalgebra::SVector;
use rayon::prelude::*;

/// Errors of depth go together over patches of about this many pixels.
const SURFACE_PATCH_PX: f64 = 400.0;
/// Errors of an outline go together over about this many pixels.
const OUTLINE_PATCH_PX: f64 = 8.0;
/// Prior deviation of the depth's scale.
pub(super) const DEPTH_SCALE_PRIOR: f64 = 0.01;
/// Prior deviation of the outline's excess, pixels.
pub(super) const OUTLINE_PRIOR_PX: f64 = 1.0;

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

/// How residuals are weighed in one step.
#[derive(Clone, Copy)]
pub(super) struct Weighing {
    pub scales: Scales,
    pub sigma: Scales,
    pub trust: Trust,
}

impl Weighing {
    /// Weighs `evidence` by its own deviations.
    pub fn of(evidence: &[Evidence], scales: &Scales, trust: Trust) -> Self {
        Self { scales: *scales, sigma: deviations(evidence, scales), trust }
    }

    pub fn surface(&self, evidence: &Evidence, factor: &Factor) -> f64 {
        let patches = (evidence.pixels_per_point / SURFACE_PATCH_PX).min(1.0);
        let robust = geman_mcclure(factor.residual, self.scales.surface_m);
        self.trust.in_surfaces() * patches * robust / self.sigma.surface_m.powi(2)
    }

    pub fn outline(&self, evidence: &Evidence, factor: &Factor) -> f64 {
        let patches = (evidence.cracks_per_factor / OUTLINE_PATCH_PX).min(1.0);
        let robust = geman_mcclure(factor.residual, self.scales.outline_px);
        self.trust.in_outlines() * patches * robust / self.sigma.outline_px.powi(2)
    }

    /// The linearised problem of all views, with the priors. Views are added in their order.
    pub fn total(&self, evidence: &[Evidence], state: &State) -> NormalEquations<UNKNOWNS> {
        let views: Vec<_> = evidence.par_iter().map(|view| self.one_view(view)).collect();
        let mut sum = NormalEquations::default();
        for view in &views {
            sum.add_all(view);
        }
        let priors = [
            (DEPTH_SCALE, state.depth_scale, DEPTH_SCALE_PRIOR),
            (OUTLINE_WIDTH, state.outline_px, OUTLINE_PRIOR_PX),
        ];
        for (unknown, value, deviation) in priors {
            sum.add(&SVector::ith(unknown, 1.0), value, deviation.powi(-2));
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
