//! Clouds in NPY.

use super::stored::{FIELD, Stored, invalid};
use crate::depth::shape_text;
use crate::error::RecordingError;
use crate::npy::{Dtype, Npy};
use std::path::Path;

/// Reads an array of rows x columns x 3, or of points x 3.
pub(super) fn read(path: &Path) -> Result<Stored, RecordingError> {
    let npy = Npy::read(path, FIELD, &[Dtype::Float32, Dtype::Float64])?;
    let grid = grid(path, npy.shape())?;
    Ok(Stored { xyz: npy.values(), grid })
}

/// Width and height where the shape is an image's.
fn grid(path: &Path, shape: &[usize]) -> Result<Option<(u32, u32)>, RecordingError> {
    let size = |axis: usize| u32::try_from(axis).ok();
    match *shape {
        [_, 3] | [1, _, 3] => Ok(None),
        [height, width, 3] if size(width).is_some() && size(height).is_some() => {
            Ok(size(width).zip(size(height)))
        }
        _ => Err(invalid(
            path,
            format!("the array is {}", shape_text(shape)),
            "Store x, y, z as rows x columns x 3 (organised), or as points x 3",
        )),
    }
}
