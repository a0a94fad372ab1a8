//! One arm configuration as the camera saw it.

use crate::arm::Posture;
use crate::depth_margin::Margin;
use eyebolt_geometry::{DepthImage, Mask, PinholeCamera};
use nalgebra::{Point2, Point3};

/// A depth frame, the arm's configuration in it, and what is known of which pixels are the arm.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    /// The camera.
    pub camera: &'a PinholeCamera,
    /// What it saw, of the camera's size.
    pub depth: &'a DepthImage,
    /// What depth seen has to be multiplied by to be true depth, as far as is known: 1 at first.
    pub depth_factor: f32,
    /// The whole arm's pixels, where somebody marked them.
    pub mask: Option<&'a Mask>,
    /// The arm's links in the base frame.
    pub posture: &'a Posture,
}

/// What a view says of a point that should be on the arm's surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Consistency {
    /// The camera saw something about there.
    Agrees,
    /// The camera saw through it, or it lies outside the arm's mask.
    Contradicts,
    /// Hidden behind something, out of the image, or no depth there.
    Unknown,
}

impl View<'_> {
    /// True depth at row-major pixel `at`, metres, as far as is known; 0 where nothing was seen.
    ///
    /// # Panics
    ///
    /// Beyond the last pixel.
    pub fn depth_m(&self, at: usize) -> f32 {
        self.depth_factor * self.depth.depth_m()[at]
    }

    /// What the view says of a surface point of the arm at `point_in_camera`.
    pub fn consistency(&self, point_in_camera: &Point3<f32>) -> Consistency {
        let Some(pixel) = self.camera.project(&point_in_camera.cast()) else {
            return Consistency::Unknown;
        };
        self.consistency_at(&pixel, point_in_camera.z)
    }

    fn consistency_at(&self, pixel: &Point2<f64>, z: f32) -> Consistency {
        if !self.camera.contains(pixel) {
            return Consistency::Unknown;
        }
        // Rounds, since both are above -0.5; `round` is a call on most CPUs.
        let (u, v) = ((pixel.x + 0.5) as u32, (pixel.y + 0.5) as u32);
        let seen = self.depth_factor * self.depth.at(u, v);
        let tolerance = Margin::Search.at_m(z);
        if seen > 0.0 && seen < z - tolerance {
            return Consistency::Unknown;
        }
        if self.mask.is_some_and(|mask| !mask.at(u, v)) {
            return Consistency::Contradicts;
        }
        if seen <= 0.0 {
            return Consistency::Unknown;
        }
        // The far side of a thick link lies behind the side that was seen.
        if seen > z + tolerance { Consistency::Contradicts } else { Consistency::Agrees }
    }
}
