//! Weighted sums of squared distances from planes, as one quadratic form.

use nalgebra::{Matrix3, Point3, Vector3};
use std::ops::{Add, AddAssign};

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
    pub(super) fn optimum(&self, near: &Point3<f64>) -> Option<Optimum> {
        let slope = self.a * near.coords + self.b;
        let pulled = self.a + Matrix3::identity() * (PULL * self.a.trace());
        let inverse = pulled.try_inverse()?;
        let point = near - inverse * slope;
        point.iter().all(|x| x.is_finite()).then_some(Optimum { point, inverse })
    }
}

/// Where a quadric is least, and how it grows around.
pub(super) struct Optimum {
    point: Point3<f64>,
    /// Of the quadratic part.
    inverse: Matrix3<f64>,
}

impl Optimum {
    pub(super) fn point(&self) -> Point3<f64> {
        self.point
    }

    /// Where the quadric is least on a plane, given by a normal of any length and a point.
    pub(super) fn on(
        &self,
        (normal, through): &(Vector3<f64>, Point3<f64>),
    ) -> Option<Point3<f64>> {
        let steepest = self.inverse * normal;
        let point =
            self.point + steepest * (normal.dot(&(through - self.point)) / normal.dot(&steepest));
        point.iter().all(|x| x.is_finite()).then_some(point)
    }
}

impl Add for Quadric {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            a: self.a + other.a,
            b: self.b + other.b,
            c: self.c + other.c,
            weight: self.weight + other.weight,
        }
    }
}

impl AddAssign for Quadric {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
