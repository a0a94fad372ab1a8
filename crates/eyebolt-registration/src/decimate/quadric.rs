//! Weighted sums of squared distances from planes, as one quadratic form.

use nalgebra::{Matrix3, Point3, Vector3};
use std::ops::AddAssign;

/// `q(x) = xᵀ A x + 2 bᵀ x + c`, the sum over planes of weight times squared distance.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Quadric {
    a: Matrix3<f64>,
    b: Vector3<f64>,
    c: f64,
    weight: f64,
}

/// How hard the optimum is drawn to where it was sought, relative to the planes. Near-parallel
/// planes cross far away: without this a vertex of a gently bent sheet would run there.
const PULL: f64 = 1e-3;

impl Quadric {
    /// That of the plane with unit `normal` through `point`.
    pub(super) fn plane(normal: &Vector3<f64>, point: &Point3<f64>, weight: f64) -> Self {
        let offset = -normal.dot(&point.coords);
        Self {
            a: normal * normal.transpose() * weight,
            b: normal * (offset * weight),
            c: offset * offset * weight,
            weight,
        }
    }

    /// Mean of the squared distances of `x` from the planes, square metres; zero without planes.
    pub(super) fn mean_square(&self, x: &Point3<f64>) -> f64 {
        if self.weight <= 0.0 {
            return 0.0;
        }
        let x = &x.coords;
        let sum = x.dot(&(self.a * x)) + 2.0 * self.b.dot(x) + self.c;
        // Rounding takes sums of nothing below zero.
        (sum / self.weight).max(0.0)
    }

    /// Where the sum is least: of such points, the one nearest to `near`.
    pub(super) fn optimum(&self, near: &Point3<f64>) -> Option<Point3<f64>> {
        let pull = PULL * self.a.trace();
        let slope = self.a * near.coords + self.b;
        let pulled = self.a + Matrix3::identity() * pull;
        let optimum = near - pulled.cholesky()?.solve(&slope);
        optimum.iter().all(|x| x.is_finite()).then_some(optimum)
    }
}

impl AddAssign for Quadric {
    fn add_assign(&mut self, other: Self) {
        self.a += other.a;
        self.b += other.b;
        self.c += other.c;
        self.weight += other.weight;
    }
}
