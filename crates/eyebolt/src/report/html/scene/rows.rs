//! Transforms as numbers.

use eyebolt_geometry::{Frame, Transform};

/// The upper three rows of the matrix, row by row.
pub(super) fn rows<To: Frame, From: Frame>(pose: &Transform<To, From>) -> [f32; 12] {
    let matrix = pose.matrix();
    std::array::from_fn(|at| matrix[(at / 4, at % 4)] as f32)
}
