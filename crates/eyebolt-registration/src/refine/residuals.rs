//! What an answer leaves over in one view.

use super::gather::{ViewFactors, gather_one};
use super::outcome::Refinement;
use super::start::RefineView;
use crate::arm::ArmModel;
use crate::evidence::Factor;
use crate::unknowns::{EVIDENCE_KINDS, State};
use eyebolt_render::Raster;

/// What one piece of evidence leaves over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// The link of the [`ArmModel`] that it is about.
    pub link: usize,
    /// In the unit of its kind of evidence.
    pub value: f64,
}

/// The residuals of each kind of evidence in `view` at the answer `refinement`, as the refinement
/// measures them. `raster` is drawn anew, with the arm where the answer has it.
pub fn residuals(
    arm: &ArmModel,
    view: &RefineView<'_>,
    raster: &mut Raster,
    refinement: &Refinement,
) -> [Vec<Residual>; EVIDENCE_KINDS] {
    let state = State::from(refinement.end());
    let mut gathered = ViewFactors::default();
    gather_one(arm, view, raster, &state, &mut gathered);
    let residual = |factor: &Factor| Residual { link: factor.link, value: factor.residual };
    gathered.factors.map(|factors| factors.iter().map(residual).collect())
}
