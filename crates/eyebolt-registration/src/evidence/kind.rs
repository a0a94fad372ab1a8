//! What every kind of evidence has to say.

use super::posed::PosedView;
use crate::unknowns::Unknowns;

/// A residual with its derivative by the unknowns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Factor {
    /// In the kind's unit.
    pub residual: f64,
    pub jacobian: Unknowns,
    /// The link that the evidence is about.
    pub link: usize,
}

/// How far off a pose may be that is refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// By several centimetres: a candidate of the search.
    Far,
    /// By a few centimetres.
    Near,
    /// By less than the noise of single pixels.
    Close,
}

/// How people are shown what a kind of evidence leaves over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Presentation {
    /// What the evidence is called, in the plural: `surfaces`.
    pub name: &'static str,
    /// The unit it is shown in.
    pub unit: &'static str,
    /// Residuals are shown times this.
    pub factor: f64,
    /// What a positive number means.
    pub positive: &'static str,
}

/// One kind of evidence: residuals that are comparable with each other, and what they are worth.
pub(crate) trait EvidenceKind: Sync {
    fn presentation(&self) -> Presentation;

    /// Scale of the robust kernel in the first step of a refinement; it shrinks from there to
    /// three standard deviations of the residuals.
    fn first_scale(&self, reach: Reach) -> f64;

    /// Residuals are never taken to scatter less than this.
    fn least_deviation(&self) -> f64;

    /// Nor does the kernel's scale shrink below three times this.
    fn least_kernel_deviation(&self) -> f64 {
        0.0
    }

    /// Errors go together over about so many samples, which count as one.
    fn correlated_samples(&self) -> f64;

    /// Standard deviation of the Gaussian prior of the nuisance parameter, whose mean is zero.
    fn nuisance_deviation(&self) -> f64;

    /// Whether the posed arm has to be drawn for it.
    fn needs_drawing(&self) -> bool;

    /// Adds the factors of one view; returns how many samples each stands for.
    fn gather(&self, posed: &PosedView<'_>, factors: &mut Vec<Factor>) -> f64;
}
