//! A projection without skew, and what it is fitted to.

use nalgebra::{Point2, UnitQuaternion, Vector3};

/// A pixel and the unit direction of its point in the frame of the cloud.
pub(super) struct Sighting {
    pub(super) pixel: Point2<f64>,
    pub(super) direction: Vector3<f64>,
}

/// Intrinsics without skew (pixels) and the rotation from the cloud to the camera.
#[derive(Clone, Copy)]
pub(super) struct Projection {
    pub(super) fx: f64,
    pub(super) fy: f64,
    pub(super) cx: f64,
    pub(super) cy: f64,
    pub(super) rotation: UnitQuaternion<f64>,
}

impl Projection {
    /// Projection minus pixel; infinite for a point that is not in front.
    pub(super) fn error_px(&self, sighting: &Sighting) -> f64 {
        let p = self.rotation * sighting.direction;
        if p.z <= 0.0 {
            return f64::INFINITY;
        }
        let projected = Point2::new(self.fx * p.x / p.z + self.cx, self.fy * p.y / p.z + self.cy);
        (projected - sighting.pixel).norm()
    }
}
