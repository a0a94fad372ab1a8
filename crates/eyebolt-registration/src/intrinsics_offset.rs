//! Intrinsics that may be off.

use nalgebra::{Matrix3, Point3};

/// How many numbers there are to an [`IntrinsicsOffset`].
pub const INTRINSICS: usize = 3;

/// How far the true intrinsics are from those that the recording states.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct IntrinsicsOffset {
    /// The true focal lengths are `1 + this` times those stated.
    pub focal: f64,
    /// Where the true principal point is from the one stated, along x and y, in focal lengths.
    pub centre: [f64; 2],
}

impl IntrinsicsOffset {
    /// Takes a true point to one that the camera as stated sees where the true camera sees the true
    /// one.
    pub fn stated_from_true(&self) -> Matrix3<f64> {
        let [a, b] = self.centre;
        let focal = 1.0 + self.focal;
        Matrix3::new(focal, 0.0, a, 0.0, focal, b, 0.0, 0.0, 1.0)
    }

    /// Where a point is in truth that the camera as stated takes for `stated`.
    pub fn true_point(&self, stated: &Point3<f64>) -> Point3<f64> {
        let [a, b] = self.centre;
        let (x, y, z) = (stated.x - a * stated.z, stated.y - b * stated.z, stated.z);
        Point3::new(x / (1.0 + self.focal), y / (1.0 + self.focal), z)
    }

    pub(crate) fn numbers(&self) -> [f64; INTRINSICS] {
        [self.focal, self.centre[0], self.centre[1]]
    }

    pub(crate) fn from_numbers([focal, x, y]: [f64; INTRINSICS]) -> Self {
        Self { focal, centre: [x, y] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn there_and_back(
            focal in -0.1..0.1_f64, a in -0.05..0.05_f64, b in -0.05..0.05_f64,
            x in -1.0..1.0_f64, y in -1.0..1.0_f64, z in 0.3..3.0_f64,
        ) {
            let offset = IntrinsicsOffset { focal, centre: [a, b] };
            let point = Point3::new(x, y, z);
            let back = offset.true_point(&(offset.stated_from_true() * point));
            prop_assert!((back - point).norm() < 1e-12);
        }
    }
}
