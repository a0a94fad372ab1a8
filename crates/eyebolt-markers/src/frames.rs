//! Frames of this crate.

use eyebolt_geometry::CoordinateFrame;

/// A marker or a board of them: x right, y down as it is printed, z into it. A single tag has its origin in
/// its middle, boards in the upper left corner of the whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Marker;

impl CoordinateFrame for Marker {
    const NAME: &'static str = "marker";
}
