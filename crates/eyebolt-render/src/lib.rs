//! Depth images and silhouettes of a posed robot.
//!
//! A z-buffer over triangles: fast enough to be redrawn in every step of a registration. And rays,
//! which see both sides of a triangle, bend with the lens, and cast shadows. Light, colour and
//! sensor noise are none of their business.

mod contour;
mod random;
mod raster;
mod rays;
mod view;

pub use contour::{ContourPoint, contour, outer_contour};
pub use random::Random;
pub use raster::{PosedMesh, Raster};
pub use rays::{Hit, RayScene, SceneMesh};
pub use view::View;
