//! A box along the axes of the end-effector frame.

use nalgebra::{Point3, Vector3};

/// A box along the axes of the end-effector frame, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingBox {
    /// Corner of the least coordinates.
    pub low: Point3<f64>,
    /// Corner of the greatest.
    pub high: Point3<f64>,
}

impl BoundingBox {
    /// The smallest box about `points`; `None` without any.
    pub fn about(points: impl IntoIterator<Item = Point3<f64>>) -> Option<Self> {
        let one = |point| Self { low: point, high: point };
        points
            .into_iter()
            .map(one)
            .reduce(|a, b| Self { low: a.low.inf(&b.low), high: a.high.sup(&b.high) })
    }

    /// Whether `point_in_end_effector` lies in it or on its rim.
    pub fn contains(&self, point_in_end_effector: &Point3<f64>) -> bool {
        (0..3).all(|axis| (self.low[axis]..=self.high[axis]).contains(&point_in_end_effector[axis]))
    }

    /// The box, `margin_m` wider to every side.
    #[must_use]
    pub fn widened(&self, margin_m: f64) -> Self {
        let margin = Vector3::repeat(margin_m);
        Self { low: self.low - margin, high: self.high + margin }
    }

    /// Its middle, metres.
    pub fn centre(&self) -> Point3<f64> {
        nalgebra::center(&self.low, &self.high)
    }

    /// Lengths of its sides, metres.
    pub fn size_m(&self) -> Vector3<f64> {
        self.high - self.low
    }

    /// Its eight corners, those of the least z first.
    pub fn corners(&self) -> [Point3<f64>; 8] {
        std::array::from_fn(|corner| {
            let side = |axis: usize| match corner >> axis & 1 {
                0 => self.low[axis],
                _ => self.high[axis],
            };
            Point3::new(side(0), side(1), side(2))
        })
    }
}
