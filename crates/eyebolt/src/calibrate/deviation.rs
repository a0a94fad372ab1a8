//! How far two poses are apart.

use eyebolt_geometry::{Base, Camera, Transform};
use nalgebra::Point3;

/// A difference between two poses, or its expected size.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Distance that the centre of the workspace moves, metres.
    pub translation_m: f64,
    /// Angle, radians.
    pub rotation_rad: f64,
}

impl Deviation {
    /// How far `a` and `b` are apart at a point of the base frame, metres.
    pub fn between(
        a: &Transform<Camera, Base>,
        b: &Transform<Camera, Base>,
        at_in_base: &Point3<f64>,
    ) -> Self {
        Self {
            translation_m: (a.point(at_in_base) - b.point(at_in_base)).norm(),
            rotation_rad: a.rotation().angle_to(&b.rotation()),
        }
    }

    /// The larger of each of the two numbers.
    #[must_use]
    pub fn larger(self, other: Self) -> Self {
        Self {
            translation_m: self.translation_m.max(other.translation_m),
            rotation_rad: self.rotation_rad.max(other.rotation_rad),
        }
    }
}
