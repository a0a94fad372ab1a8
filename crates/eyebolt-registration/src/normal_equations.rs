//! Weighted least squares, summed up.

use nalgebra::{SMatrix, SVector};

/// `H delta = -g` of a least-squares problem with `N` unknowns.
///
/// Sums are taken in a fixed order by whoever adds, so the same data give the same bits on any
/// number of threads.
#[derive(Clone, Debug, PartialEq)]
pub struct NormalEquations<const N: usize> {
    /// Sum of `w J^T J`.
    pub information: SMatrix<f64, N, N>,
    /// Sum of `w J^T r`.
    pub gradient: SVector<f64, N>,
    /// Sum of the weights.
    pub weight: f64,
}

impl<const N: usize> Default for NormalEquations<N> {
    fn default() -> Self {
        Self { information: SMatrix::zeros(), gradient: SVector::zeros(), weight: 0.0 }
    }
}

impl<const N: usize> NormalEquations<N> {
    /// Adds one residual with derivative `jacobian` and weight `weight`.
    pub fn add(&mut self, jacobian: &SVector<f64, N>, residual: f64, weight: f64) {
        self.information.ger(weight, jacobian, jacobian, 1.0);
        self.gradient.axpy(weight * residual, jacobian, 1.0);
        self.weight += weight;
    }

    /// As [`Self::add`] where the square counts `curvature`, which may be negative, and the slope `weight`;
    /// but of the information only what lies on and below the diagonal, which [`Self::mirror`] completes.
    /// Derivatives that are zero cost nothing.
    pub(crate) fn add_lower(
        &mut self,
        jacobian: &SVector<f64, N>,
        residual: f64,
        weight: f64,
        curvature: f64,
    ) {
        let along = jacobian.as_slice();
        for (c, column) in self.information.as_mut_slice().chunks_exact_mut(N).enumerate() {
            if along[c] == 0.0 {
                continue;
            }
            let scaled = curvature * along[c];
            for (sum, along) in column[c..].iter_mut().zip(&along[c..]) {
                *sum += scaled * along;
            }
        }
        self.gradient.axpy(weight * residual, jacobian, 1.0);
        self.weight += weight;
    }

    /// Copies what lies below the diagonal of the information to above it.
    pub(crate) fn mirror(&mut self) {
        self.information.fill_upper_triangle_with_lower_triangle();
    }

    /// Adds another sum, `factor` times.
    pub(crate) fn add_scaled(&mut self, other: &Self, factor: f64) {
        self.information += other.information * factor;
        self.gradient += other.gradient * factor;
        self.weight += other.weight * factor;
    }

    /// Takes another sum away.
    pub(crate) fn subtract_all(&mut self, other: &Self) {
        self.add_scaled(other, -1.0);
    }

    /// Counts all so far `factor` times.
    pub(crate) fn scale(&mut self, factor: f64) {
        self.information *= factor;
        self.gradient *= factor;
        self.weight *= factor;
    }

    /// Adds another sum.
    pub fn add_all(&mut self, other: &Self) {
        self.information += other.information;
        self.gradient += other.gradient;
        self.weight += other.weight;
    }

    /// The step that minimises the linearised problem, with `damping` times the diagonal added.
    ///
    /// `None` where the data do not determine every unknown.
    pub fn solve(&self, damping: f64) -> Option<SVector<f64, N>> {
        let mut damped = self.information;
        for i in 0..N {
            damped[(i, i)] *= 1.0 + damping;
        }
        let step = damped.cholesky()?.solve(&-self.gradient);
        step.iter().all(|v| v.is_finite()).then_some(step)
    }
}
