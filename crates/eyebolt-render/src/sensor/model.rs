//! A model of a depth camera.

use super::figures::{TimeOfFlight, Triangulation};
use eyebolt_geometry::{Distortion, PinholeCamera};
use std::fmt;

/// A model of a depth camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensor {
    /// What it is called.
    pub name: &'static str,
    /// What it is, in a line.
    pub about: &'static str,
    /// The image of its usual mode.
    pub mode: Mode,
    /// Nearest and farthest depth that it tells, metres.
    pub range_m: [f64; 2],
    /// Whether its ROS driver tells depth in whole millimetres (`16UC1`) rather than as floating
    /// point metres (`32FC1`). Frames are not rounded: that is left to whoever encodes them.
    pub in_millimetres: bool,
    /// How it measures.
    pub family: Family,
}

/// The image of a sensor's usual mode: no distortion, the axis through the middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// Pixels in a row.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// Focal length, pixels.
    pub focal_px: f64,
}

/// How a depth camera measures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Family {
    /// Without error.
    Ideal,
    /// By the angle between two rays: structured light, stereo.
    Triangulation(Triangulation),
    /// By the time that light takes.
    TimeOfFlight(TimeOfFlight),
}

impl Sensor {
    /// The camera of the sensor's usual mode.
    pub fn camera(&self) -> PinholeCamera {
        let Mode { width, height, focal_px } = self.mode;
        let middle = |size: u32| 0.5 * (f64::from(size) - 1.0);
        let (cx, cy) = (middle(width), middle(height));
        PinholeCamera::new(width, height, focal_px, focal_px, cx, cy, Distortion::None)
            .expect("a row of figures has a size and a focal length")
    }

    /// Where the second lens or the projector is in the camera's frame, metres along x.
    pub fn baseline_m(&self) -> Option<f64> {
        match &self.family {
            Family::Ideal | Family::TimeOfFlight(_) => None,
            Family::Triangulation(figures) => Some(figures.baseline_m),
        }
    }
}

impl fmt::Display for Sensor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}
