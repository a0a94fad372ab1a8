//! Depth cameras: what a real one makes of what an ideal one sees.
//!
//! A [`Sensor`] is a row of figures from the literature and the family of physics that they belong
//! to. One specimen of it looks at a posed scene once ([`Sensor::look`]): what stays the same from
//! frame to frame, shadows and fattened edges among it, is worked out there. Frames are then cheap
//! ([`Exposure::frame`]).

mod exposure;
mod field;
mod geometry;
mod laws;
mod models;
mod multipath;
mod specimen;
mod time_of_flight;
mod triangulation;
mod window;

pub use exposure::Exposure;
pub use laws::{AxialNoise, LateralNoise};
pub use specimen::{IntrinsicsError, Specimen};
pub use time_of_flight::TimeOfFlight;
pub use triangulation::{Triangulation, Window};

use crate::rays::RayScene;
use crate::view::View;
use eyebolt_geometry::{Base, Camera, Distortion, PinholeCamera, RayTable, Transform};
use nalgebra::Point3;
use std::fmt;
use std::str::FromStr;

/// A model of a depth camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensor {
    /// What it is called on a command line.
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
    /// The names of all models.
    pub fn names() -> impl Iterator<Item = &'static str> {
        Self::ALL.iter().map(|sensor| sensor.name)
    }

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

    /// What `specimen` makes of `scene`, with `camera` at a pose.
    ///
    /// All that frames have in common is worked out here, once per configuration of the scene.
    /// `camera` may be another than [`Self::camera`], a crop of it for instance.
    pub fn look(
        &self,
        scene: &RayScene,
        camera: &PinholeCamera,
        base_from_camera: &Transform<Base, Camera>,
        specimen: &Specimen,
    ) -> Exposure {
        let rays = RayTable::new(camera);
        let view = scene.view_along(&rays, base_from_camera);
        let second_sees = self.baseline_m().map_or(Vec::new(), |baseline_m| {
            let pose = base_from_camera.isometry().cast::<f32>();
            let points = view.depth_m.iter().zip(rays.rays());
            // Where nothing is seen the point is the lens itself: seen or not, it has no depth.
            let in_base = |(z, [x, y]): (&f32, &[f32; 2])| match *z {
                0.0 => pose.translation.vector.into(),
                z => pose * Point3::new(x * z, y * z, z),
            };
            let points: Vec<Point3<f32>> = points.map(in_base).collect();
            scene.visible_from(base_from_camera.point(&Point3::new(baseline_m, 0.0, 0.0)), &points)
        });
        self.expose(&view, camera, &second_sees, specimen)
    }

    /// What `specimen` makes of `view`, the ideal view of `camera`.
    ///
    /// `second_sees` tells of each pixel whether the point seen there is in sight of the second
    /// lens, or lit by the projector, [`Self::baseline_m`] to the side; it is not read if there is
    /// none.
    ///
    /// # Panics
    ///
    /// If the three are not of one size.
    pub fn expose(
        &self,
        view: &View,
        camera: &PinholeCamera,
        second_sees: &[bool],
        specimen: &Specimen,
    ) -> Exposure {
        assert_eq!(view.depth_m.len(), camera.pixel_count(), "the view is the camera's");
        let mut exposure = match &self.family {
            Family::Ideal => Exposure::of_depth(view, specimen),
            Family::Triangulation(figures) => {
                assert_eq!(second_sees.len(), view.depth_m.len(), "each pixel is seen or not");
                triangulation::expose(figures, view, camera, second_sees, specimen)
            }
            Family::TimeOfFlight(figures) => {
                time_of_flight::expose(figures, view, camera, specimen)
            }
        };
        exposure.range_m = self.range_m.map(|depth| depth as f32);
        exposure
    }
}

impl fmt::Display for Sensor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

impl FromStr for Sensor {
    type Err = UnknownSensor;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        let found = Self::ALL.iter().find(|sensor| sensor.name == name);
        found.copied().ok_or_else(|| UnknownSensor(name.to_owned()))
    }
}

/// There is no model of that name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownSensor(pub String);

impl fmt::Display for UnknownSensor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<&str> = Sensor::names().collect();
        write!(f, "sensor {:?} is not known; use one of {}", self.0, names.join(", "))
    }
}

impl std::error::Error for UnknownSensor {}
