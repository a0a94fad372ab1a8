//! Depth images and silhouettes of a posed robot.
//!
//! A z-buffer over triangles ([`Raster`]): fast enough to be redrawn in every step of a
//! registration. Rays into a whole scene ([`RayScene`]), which see both sides of a triangle, bend
//! with the lens and cast shadows, and what real depth cameras make of it ([`Sensor`]): for
//! recordings with a known answer. Light and colour are none of its business.

mod contour;
mod random;
mod raster;
mod rays;
mod sensor;
mod view;

pub use contour::{ContourPoint, contour, outer_contour};
pub use random::Random;
pub use raster::{PosedMesh, Raster};
pub use rays::{Hit, RayScene, SceneMesh};
pub use sensor::{
    AxialNoise, Exposure, Family, Field, IntrinsicsError, LateralNoise, Mode, Sensor, Specimen,
    TimeOfFlight, Triangulation, UnknownSensor, Window,
};
pub use view::IdealView;
