//! Joints of one frame in NPY: numbers without names.

use super::positions::{FIELD, in_order, invalid};
use crate::depth::shape_text;
use crate::error::RecordingError;
use crate::npy::{Dtype, Npy};
use eyebolt_robot::JointPositions;
use std::path::Path;

/// Reads one position per name.
pub(super) fn read(path: &Path, names: &[String]) -> Result<JointPositions, RecordingError> {
    let npy = Npy::read(path, FIELD, &[Dtype::Float32, Dtype::Float64])?;
    let ([_] | [1, _] | [_, 1]) = *npy.shape() else {
        let problem = format!("the array is {}", shape_text(npy.shape()));
        return Err(invalid(path, problem, "Store one position per joint, and one file per frame"));
    };
    in_order(path, names, npy.values())
}
