//! Points of a marker where a picture shows them.

use nalgebra::{Point2, Point3};

/// A point of a marker, and where it was seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correspondence {
    /// The point, metres.
    pub point_in_marker: Point3<f64>,
    /// Where it was seen, pixels.
    pub pixel: Point2<f64>,
}
