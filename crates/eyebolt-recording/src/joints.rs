//! Joint positions in NPY.

use crate::depth::shape_text;
use crate::error::RecordingError;
use crate::npy::{Dtype, Npy};
use eyebolt_robot::JointPositions;
use std::f64::consts::PI;
use std::path::Path;

const FIELD: &str = "joints";

/// No joint of an arm turns further, radians.
const LARGEST_RAD: f64 = 4.0 * PI;

/// Reads one position per name, radians (metres for prismatic joints).
pub(crate) fn read_joints(path: &Path, names: &[String]) -> Result<JointPositions, RecordingError> {
    let npy = Npy::read(path, FIELD, &[Dtype::Float32, Dtype::Float64])?;
    let ([count] | [1, count] | [count, 1]) = *npy.shape() else {
        let problem = format!("the array is {}", shape_text(npy.shape()));
        let remedy = "Store one position per joint, and one file per frame";
        return Err(RecordingError::invalid(path, FIELD, problem, remedy));
    };
    if count != names.len() {
        return Err(RecordingError::invalid(
            path,
            FIELD,
            format!("the file has {count} positions, but joint_names has {} names", names.len()),
            "Correct frames.joint_names in recording.toml: one name per position, in their order",
        ));
    }
    let positions: Vec<f64> = npy.values();
    for (name, position) in names.iter().zip(&positions) {
        check(path, FIELD, name, *position)?;
    }
    Ok(names.iter().cloned().zip(positions).collect())
}

/// Refuses what cannot be the position of a joint of an arm; `field` is where it stands.
pub(crate) fn check(
    path: &Path,
    field: &str,
    name: &str,
    position: f64,
) -> Result<(), RecordingError> {
    let (problem, remedy) = if !position.is_finite() {
        (format!("the position of {name} is {position}"), "Record the frame again, or leave it out")
    } else if looks_like_degrees(position) {
        (
            format!("the position of {name} is {position}, which looks like degrees"),
            "Store radians (and metres for prismatic joints)",
        )
    } else {
        return Ok(());
    };
    Err(RecordingError::invalid(path, field, problem, remedy))
}

/// Whether no joint of an arm turns so far.
pub(crate) fn looks_like_degrees(position: f64) -> bool {
    position.abs() > LARGEST_RAD
}
