//! What is wrong with one camera, as opposed to its model.

use crate::random::Random;
use eyebolt_geometry::{CameraError, PinholeCamera};

/// One camera of its model: what it gets wrong in the same way in every frame.
#[derive(Clone, Copy, Debug)]
pub struct Specimen {
    /// Chooses the errors that are the same in every frame.
    pub random: Random,
    /// What true depth is multiplied by before it is measured; 1 for a calibrated camera.
    pub depth_scale: f64,
    /// What is then added, metres; 0 for a calibrated camera.
    pub depth_offset_m: f64,
}

impl Specimen {
    /// A calibrated camera.
    pub fn new(random: Random) -> Self {
        Self { random, depth_scale: 1.0, depth_offset_m: 0.0 }
    }

    /// The depth that the camera takes `depth_m` for; 0 remains 0.
    pub(super) fn depth_m(&self, depth_m: f32) -> f32 {
        if depth_m > 0.0 {
            (f64::from(depth_m) * self.depth_scale + self.depth_offset_m) as f32
        } else {
            0.0
        }
    }
}

/// How far stated intrinsics are from the true ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IntrinsicsError {
    /// What the true focal lengths fx and fy are multiplied by.
    pub focal_scale: [f64; 2],
    /// What is added to the true principal point cx and cy, pixels.
    pub centre_px: [f64; 2],
}

impl IntrinsicsError {
    /// Stated as they are.
    pub const NONE: Self = Self { focal_scale: [1.0; 2], centre_px: [0.0; 2] };

    /// The camera that is stated where `camera` is the true one.
    ///
    /// # Errors
    ///
    /// A focal length that is then not positive, or a number that is not finite.
    pub fn stated(&self, camera: &PinholeCamera) -> Result<PinholeCamera, CameraError> {
        let [by_x, by_y] = self.focal_scale;
        let [du, dv] = self.centre_px;
        PinholeCamera::new(
            camera.width(),
            camera.height(),
            camera.fx() * by_x,
            camera.fy() * by_y,
            camera.cx() + du,
            camera.cy() + dv,
            *camera.distortion(),
        )
    }
}
