//! Positions that joints of an arm can have, and what is said of others.

use crate::error::RecordingError;
use eyebolt_robot::JointPositions;
use std::f64::consts::PI;
use std::path::Path;

/// What the files are to the recording.
pub(super) const FIELD: &str = "joints";

/// No joint of an arm turns further, radians.
const LARGEST_RAD: f64 = 4.0 * PI;

/// Most names in a file: no arm has as many joints, and no table as many columns.
pub(super) const MOST_NAMES: usize = 1000;

pub(super) fn invalid(path: &Path, problem: impl Into<String>, remedy: &str) -> RecordingError {
    RecordingError::invalid(path, FIELD, problem, remedy)
}

/// One position per name, radians (metres for prismatic joints), if all are plausible; `place` is
/// where in the file, for messages.
pub(super) fn positions(
    path: &Path,
    place: &str,
    pairs: Vec<(String, f64)>,
) -> Result<JointPositions, RecordingError> {
    for (name, position) in &pairs {
        check(path, FIELD, place, name, *position)?;
    }
    Ok(pairs.into_iter().collect())
}

/// One position for each of `names`, which are all that is known of numbers without names.
pub(super) fn in_order(
    path: &Path,
    names: &[String],
    numbers: Vec<f64>,
) -> Result<JointPositions, RecordingError> {
    let (count, expected) = (numbers.len(), names.len());
    if count != expected {
        return Err(invalid(
            path,
            format!("the file has {count} positions, but joint_names has {expected} names"),
            "Correct frames.joint_names in recording.toml: one name per position, in their order",
        ));
    }
    positions(path, "", names.iter().cloned().zip(numbers).collect())
}

/// Refuses what cannot be the position of a joint of an arm; `field` is where it stands, `place`
/// where in it.
pub(crate) fn check(
    path: &Path,
    field: &str,
    place: &str,
    name: &str,
    position: f64,
) -> Result<(), RecordingError> {
    let (problem, remedy) = if !position.is_finite() {
        (
            format!("{place}the position of {name} is {position}"),
            "Record the frame again, or leave it out",
        )
    } else if looks_like_degrees(position) {
        (
            format!("{place}the position of {name} is {position}, which looks like degrees"),
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
