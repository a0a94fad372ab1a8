//! What the answer leaves over in each configuration, as the refinement measures it.

use crate::observations::{Configuration, Observations};
use crate::refine::observe_one;
use eyebolt_registration::{EVIDENCE_KINDS, Labels, Refinement, Residual, presentation, residuals};
use eyebolt_render::Raster;
use rayon::prelude::*;

/// What one configuration leaves over.
#[derive(Clone, Debug)]
pub(super) struct Leftover {
    /// What each pixel about the arm is taken for.
    pub(super) labels: Labels,
    /// Link and residual of each piece of evidence, by kind, as its
    /// [`presentation`] shows it.
    pub(super) shown: [Vec<(usize, f32)>; EVIDENCE_KINDS],
}

/// What every configuration of `observations` leaves over, those that took no part too.
pub(super) fn leftovers(observations: &Observations, refinement: &Refinement) -> Vec<Leftover> {
    observations.configurations.par_iter().map(|c| leftover(observations, c, refinement)).collect()
}

fn leftover(
    observations: &Observations,
    configuration: &Configuration,
    refinement: &Refinement,
) -> Leftover {
    let mut raster = Raster::new(&observations.camera);
    let view = observations.view(configuration);
    let (seen, labels) = observe_one(observations, &view, &mut raster, &refinement.end());
    let left = residuals(&observations.arm, &seen, &mut raster, refinement);
    let factors = presentation().map(|kind| kind.factor);
    let mut kinds = left.into_iter().zip(factors).map(|(residuals, factor)| {
        let shown = |r: &Residual| (r.link, (r.value * factor) as f32);
        residuals.iter().map(shown).collect()
    });
    Leftover { labels, shown: std::array::from_fn(|_| kinds.next().unwrap_or_default()) }
}

#[cfg(test)]
mod tests;
