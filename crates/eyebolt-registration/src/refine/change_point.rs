//! When the camera may have moved: the views before and after a change see the arm from two poses.

use super::clusters::clusters;
use super::gather::{ViewFactors, deviations, gather};
use super::gauss_newton::final_scales;
use super::outcome::Refinement;
use super::priors::with_priors;
use super::start::{RefineView, Trust};
use super::system::{Matrix, Sum, System, Weights};
use crate::arm::ArmModel;
use crate::unknowns::{POSE, State, UNKNOWNS};
use eyebolt_render::Raster;
use nalgebra::{DMatrix, DVector};

/// A place in the order of views where the camera may have moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChangePoint {
    /// Views before it.
    pub before: usize,
    /// How much better two poses explain the views than one: twice the logarithm of the likelihood ratio
    /// of the linearised problem (of normal errors, chi-square of six degrees of freedom).
    pub statistic: f64,
    /// The largest that this is when a view from before and one from after are exchanged: of errors that
    /// have nothing to do with time it is as large.
    pub exchanged: f64,
}

/// Where the camera most likely moved, if it did, with at least `least` views on either side; `None` of
/// fewer views. `views` and `rasters` are those that `refinement` was made from, in order of time.
///
/// The problem is the one of the last step, with a second pose for the views after the change (Quandt,
/// Journal of the American Statistical Association 1958, of normal equations).
pub fn change_point(
    arm: &ArmModel,
    views: &[RefineView<'_>],
    rasters: &mut [Raster],
    refinement: &Refinement,
    least: usize,
) -> Option<ChangePoint> {
    let state = State::from(refinement.end());
    let clusters = clusters(views);
    let mut gathered = vec![ViewFactors::default(); views.len()];
    gather(arm, views, rasters, &state, &mut gathered);
    let scales = final_scales(&refinement.deviations);
    let deviations = deviations(&gathered, &scales);
    let weights = Weights { scales, deviations, trust: Trust::All };
    let system = System::new(&gathered, &clusters, &weights, Matrix::Reweighted);
    let whole = with_priors(system.total(), &state, &refinement.offset_prior);
    let views: Vec<Sum> = (0..views.len()).map(|view| system.total_of(view)).collect();
    let without = whole.gradient.dot(&whole.information.cholesky()?.solve(&whole.gradient));
    let statistic = |after: &[usize]| Some(two_poses(&whole, &views, after)? - without);
    let places = least..(views.len() + 1).saturating_sub(least);
    let scored = places.filter_map(|before| {
        let after: Vec<usize> = (before..views.len()).collect();
        Some((before, statistic(&after)?))
    });
    let (before, best) = scored.max_by(|(_, a), (_, b)| a.total_cmp(b))?;
    let pairs = (0..before).flat_map(|early| (before..views.len()).map(move |late| (early, late)));
    let exchanged = pairs.filter_map(|(early, late)| {
        let after = (before..views.len()).map(|view| if view == late { early } else { view });
        statistic(&after.collect::<Vec<_>>())
    });
    Some(ChangePoint { before, statistic: best, exchanged: exchanged.fold(0.0, f64::max) })
}

/// By how much the cost falls, twice, with a second pose for the views `after`. `whole` is the problem with
/// its priors, `views` the sums of each view.
fn two_poses(whole: &Sum, views: &[Sum], after: &[usize]) -> Option<f64> {
    let mut sum = Sum::default();
    after.iter().for_each(|view| sum.add_all(&views[*view]));
    let mut information = DMatrix::zeros(UNKNOWNS + POSE, UNKNOWNS + POSE);
    let mut gradient = DVector::zeros(UNKNOWNS + POSE);
    information.view_mut((0, 0), (UNKNOWNS, UNKNOWNS)).copy_from(&whole.information);
    let of_pose = sum.information.fixed_columns::<POSE>(0);
    information.view_mut((0, UNKNOWNS), (UNKNOWNS, POSE)).copy_from(&of_pose);
    information.view_mut((UNKNOWNS, 0), (POSE, UNKNOWNS)).copy_from(&of_pose.transpose());
    let block = of_pose.fixed_rows::<POSE>(0);
    information.view_mut((UNKNOWNS, UNKNOWNS), (POSE, POSE)).copy_from(&block);
    gradient.rows_mut(0, UNKNOWNS).copy_from(&whole.gradient);
    gradient.rows_mut(UNKNOWNS, POSE).copy_from(&sum.gradient.fixed_rows::<POSE>(0));
    Some(gradient.dot(&information.cholesky()?.solve(&gradient)))
}
