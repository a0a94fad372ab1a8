//! One arm configuration as the camera saw it.

use crate::arm::Posture;
use eyebolt_geometry::{DepthImage, Mask, PinholeCamera};
use nalgebra::{Point2, Point3};

/// A depth frame, the arm's configuration in it, and what is known of which pixels are the arm.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    /// The camera.
    pub camera: &'a PinholeCamera,
    /// What it saw, of the camera's size.
    pub depth: &'a DepthImage,
    /// The whole arm's pixels, where somebody marked them.
    pub mask: Option<&'a Mask>,
    /// The arm's links in the base frame.
    pub posture: &'a Posture,
}

/// What a view says of a point that should be on the arm's surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Evidence {
    /// The camera saw something about there.
    Agrees,
    /// The camera saw through it, or it lies outside the arm's mask.
    Contradicts,
    /// Hidden behind something, out of the image, or no depth there.
    Unknown,
}

impl View<'_> {
    /// How much depth may differ at depth `z`, metres: stereo and structured light get worse with
    /// the square of the distance.
    pub fn tolerance_m(z: f32) -> f32 {
        0.03 + 0.01 * z * z
    }

    /// What the view says of a surface point of the arm at `point_in_camera`.
    pub fn evidence(&self, point_in_camera: &Point3<f32>) -> Evidence {
        let Some(pixel) = self.camera.project(&point_in_camera.cast()) else {
            return Evidence::Unknown;
        };
        self.evidence_at(&pixel, point_in_camera.z)
    }

    fn evidence_at(&self, pixel: &Point2<f64>, z: f32) -> Evidence {
        if !self.camera.contains(pixel) {
            return Evidence::Unknown;
        }
        let (u, v) = (pixel.x.round() as u32, pixel.y.round() as u32);
        let seen = self.depth.at(u, v);
        let tolerance = Self::tolerance_m(z);
        if seen > 0.0 && seen < z - tolerance {
            return Evidence::Unknown;
        }
        if self.mask.is_some_and(|mask| !mask.at(u, v)) {
            return Evidence::Contradicts;
        }
        if seen <= 0.0 {
            return Evidence::Unknown;
        }
        // The far side of a thick link lies behind the side that was seen.
        if seen > z + tolerance { Evidence::Contradicts } else { Evidence::Agrees }
    }
}
