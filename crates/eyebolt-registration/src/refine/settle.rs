//! More steps of an answer without some views, with residuals of their own.

use super::clusters::clusters;
use super::gather::{ViewFactors, deviations, gather};
use super::gauss_newton::final_scales;
use super::left_out::LeftOut;
use super::outcome::Refinement;
use super::priors::with_priors;
use super::start::{RefineView, Start, Trust};
use super::system::{Matrix, System, Weights};
use crate::arm::ArmModel;
use eyebolt_render::Raster;

/// The answer without the views of `left_out`: draws the arm anew where the first step led and takes
/// another one, `steps` times.
///
/// `views` and `rasters` are those that `refinement` was made from.
pub fn settle(
    arm: &ArmModel,
    views: &[RefineView<'_>],
    rasters: &mut [Raster],
    refinement: &Refinement,
    left_out: &LeftOut,
    steps: usize,
) -> Start {
    let kept: Vec<RefineView<'_>> = views
        .iter()
        .enumerate()
        .filter(|(view, _)| !left_out.views.contains(view))
        .map(|(_, view)| view.clone())
        .collect();
    let clusters = clusters(&kept);
    let scales = final_scales(&refinement.deviations);
    let mut gathered = vec![ViewFactors::default(); kept.len()];
    let mut end = left_out.state;
    for _ in 0..steps {
        gather(arm, &kept, &mut rasters[..kept.len()], &end, &mut gathered);
        let deviations = deviations(&gathered, &scales);
        let weights = Weights { scales, deviations, trust: Trust::All };
        let step = |matrix| {
            let system = System::new(&gathered, &clusters, &weights, matrix);
            with_priors(system.total(), &end, &refinement.offset_prior).solve(1e-6)
        };
        let Some(step) = step(Matrix::Curvature).or_else(|| step(Matrix::Reweighted)) else {
            break;
        };
        end = end.stepped(&step);
    }
    end.into()
}
