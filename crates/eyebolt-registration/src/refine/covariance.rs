//! How uncertain the unknowns are: ARCHITECTURE.md, (8).

use super::priors::priors;
use super::start::OffsetDeviations;
use super::system::{Sum, System};
use crate::unknowns::{State, UNKNOWNS, Unknowns};
use nalgebra::SMatrix;

type Covariance = SMatrix<f64, UNKNOWNS, UNKNOWNS>;

/// Of the information scaled to a diagonal of ones: between what rounding leaves of nothing, 1e-15,
/// and what three points on a surface tell.
const LEAST_EIGENVALUE: f64 = 1e-10;

/// Whether `information` is of full rank. Rounding, and the damping of the steps, make one that is
/// not look regular.
pub(super) fn determines_all(information: &Covariance) -> bool {
    let scale = information.diagonal().map(|d| d.sqrt().recip());
    let scaled = Covariance::from_fn(|i, j| information[(i, j)] * scale[i] * scale[j]);
    scaled.iter().all(|v| v.is_finite()) && scaled.symmetric_eigenvalues().min() > LEAST_EIGENVALUE
}

/// Cluster-robust covariance, which does not trust the noise model (Liang and Zeger's sandwich,
/// Biometrika 1986): the residuals of one kind of evidence on one link in one pose may all be off
/// together. Residuals are those after `step`; `total` has the priors.
///
/// `None` where the data do not determine every unknown.
pub(super) fn sandwich(
    system: &System<'_>,
    total: &Sum,
    state: &State,
    deviations: &OffsetDeviations,
    step: &Unknowns,
) -> Option<Covariance> {
    if !determines_all(&total.information) {
        return None;
    }
    let bread = total.information.try_inverse()?;
    let mut filling = Covariance::zeros();
    for cluster in system.by_cluster() {
        let score = cluster.gradient + cluster.information * step;
        filling += score * score.transpose();
    }
    for prior in priors(state, deviations) {
        filling[(prior.unknown, prior.unknown)] += prior.deviation.powi(-2);
    }
    let covariance = bread * filling * bread;
    covariance.iter().all(|v| v.is_finite()).then(|| (covariance + covariance.transpose()) * 0.5)
}
