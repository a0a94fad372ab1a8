//! What a refinement comes to: fits, information, covariance.

use super::evidence::Evidence;
use super::weighing::{Scales, Weighing};
use super::{Refinement, StopReason, ViewFit, joint_prior};
use crate::arm::MOST_JOINTS;
use crate::factors::{Factor, State, UNKNOWNS};
use crate::normal_equations::NormalEquations;
use crate::robust::median;
use nalgebra::{Matrix6, SMatrix, SVector, Vector6};

/// Of the information scaled to a diagonal of ones: between what rounding leaves of nothing, 1e-15,
/// and what three points on a surface tell.
const LEAST_EIGENVALUE: f64 = 1e-10;

/// The outcome of a refinement that ended at `state`, but for how it got there.
pub(super) fn summarise(state: &State, evidence: &[Evidence], weighing: &Weighing) -> Refinement {
    let sigma = &weighing.sigma;
    let sum = weighing.total(evidence, state);
    let views = evidence.iter().map(|view| view_fit(view, sigma)).collect();
    let all = sandwich(evidence, weighing, state, &sum, &SVector::zeros());
    let covariance = all.map(|all| all.fixed_view::<6, 6>(0, 0).into_owned());
    let inverse = sum.information.try_inverse();
    let pose_only = inverse
        .and_then(|c| c.fixed_view::<6, 6>(0, 0).into_owned().try_inverse())
        .unwrap_or_else(Matrix6::zeros);
    Refinement {
        camera_from_base: state.camera_from_base,
        joint_offsets: state.joint_offsets,
        joint_sigma_rad: joint_prior::seen(evidence, weighing, state)
            .map_or([f64::INFINITY; MOST_JOINTS], |(_, covariance)| {
                covariance.diagonal().map(f64::sqrt).into()
            }),
        joint_prior_rad: weighing.joint_prior_rad,
        depth_scale: state.depth_scale,
        outline_px: state.outline_px,
        information: pose_only,
        covariance: covariance.unwrap_or_else(|| Matrix6::from_element(f64::INFINITY)),
        surface_sigma_m: sigma.surface_m,
        outline_sigma_px: sigma.outline_px,
        views,
        iterations: 0,
        last_step: Vector6::zeros(),
        stop: if covariance.is_none() {
            StopReason::Underdetermined
        } else {
            StopReason::Converged
        },
    }
}

/// Whether `information` is of full rank. Rounding, and the damping of the steps, make one that is
/// not look regular.
fn determines_all(information: &SMatrix<f64, UNKNOWNS, UNKNOWNS>) -> bool {
    let scale = information.diagonal().map(|d| d.sqrt().recip());
    let scaled = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::from_fn(|i, j| {
        information[(i, j)] * scale[i] * scale[j]
    });
    scaled.iter().all(|v| v.is_finite()) && scaled.symmetric_eigenvalues().min() > LEAST_EIGENVALUE
}

/// Covariance that does not trust the noise model: every link in every place is one patch whose
/// residuals may all be off together, in all views that show it there (Liang and Zeger's sandwich,
/// Biometrika 1986). Residuals are those after `step`.
pub(super) fn sandwich(
    evidence: &[Evidence],
    weighing: &Weighing,
    state: &State,
    sum: &NormalEquations<UNKNOWNS>,
    step: &SVector<f64, UNKNOWNS>,
) -> Option<SMatrix<f64, UNKNOWNS, UNKNOWNS>> {
    if !determines_all(&sum.information) {
        return None;
    }
    let bread = sum.information.try_inverse()?;
    let places = evidence.iter().flat_map(|view| &view.places).map(|place| place.number + 1);
    let none = [SVector::<f64, UNKNOWNS>::zeros(); 2];
    let mut patches = vec![none; places.max().unwrap_or(0)];
    for view in evidence {
        let mut add = |factor: &Factor, kind: usize, weight: f64| {
            let residual = factor.residual + factor.jacobian.dot(step);
            let place = view.places[factor.link].number;
            patches[place][kind] += factor.jacobian * (weight * residual);
        };
        view.surface.iter().for_each(|factor| add(factor, 0, weighing.surface(view, factor)));
        view.outline.iter().for_each(|factor| add(factor, 1, weighing.outline(view, factor)));
    }
    let mut filling = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::zeros();
    for score in patches.iter().flatten() {
        filling += score * score.transpose();
    }
    for prior in weighing.priors(state) {
        filling[(prior.unknown, prior.unknown)] += prior.deviation.powi(-2);
    }
    let covariance = bread * filling * bread;
    covariance.iter().all(|v| v.is_finite()).then(|| (covariance + covariance.transpose()) * 0.5)
}

fn view_fit(view: &Evidence, sigma: &Scales) -> ViewFit {
    let mut surface: Vec<f64> = view.surface.iter().map(|f| f.residual.abs()).collect();
    let mut outline: Vec<f64> = view.outline.iter().map(|f| f.residual.abs()).collect();
    ViewFit {
        inliers: surface.iter().filter(|r| **r < 3.0 * sigma.surface_m).count(),
        surface_m: median(&mut surface).unwrap_or(f64::INFINITY),
        outline_px: median(&mut outline),
        points: view.points,
    }
}
