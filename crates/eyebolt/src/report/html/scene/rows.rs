//! Transforms as numbers.

use eyebolt_geometry::{CoordinateFrame, Transform};

/// The upper three rows of the matrix, row by row.
pub(super) fn rows<To: CoordinateFrame, From: CoordinateFrame>(
    pose: &Transform<To, From>,
) -> [f32; 12] {
    let matrix = pose.matrix();
    std::array::from_fn(|at| matrix[(at / 4, at % 4)] as f32)
}
