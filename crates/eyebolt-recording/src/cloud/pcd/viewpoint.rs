//! Where the sensor was, in the frame of the points.

use crate::error::RecordingError;
use std::path::Path;

/// What the OpenNI grabbers of PCL wrote into every file, with the quaternion's real part last: the
/// points are in the optical frame, and the sensor is at their origin.
const GRABBED: [f64; 7] = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0];

/// Refuses a sensor that is not at the origin and unturned: its pose is measured, by whatever
/// placed the cloud elsewhere, and this is what a calibration must not start from.
pub(super) fn check(path: &Path, words: &str) -> Result<(), RecordingError> {
    let invalid = |problem: String, remedy: &str| {
        Err(RecordingError::invalid(path, "VIEWPOINT", problem, remedy))
    };
    let numbers: Option<Vec<f64>> =
        words.split_ascii_whitespace().map(|w| w.parse().ok()).collect();
    let Some([tx, ty, tz, qw, qx, qy, qz]) = numbers.as_deref() else {
        let problem = "these are not 7 numbers (position, then quaternion w x y z)".to_owned();
        return invalid(problem, "Write VIEWPOINT 0 0 0 1 0 0 0, if the sensor is at the origin");
    };
    // The recording says which frame the points are in.
    if [*tx, *ty, *tz, *qw, *qx, *qy, *qz] == GRABBED {
        return Ok(());
    }
    // A quaternion and its negative are the same rotation.
    if [*tx, *ty, *tz, *qx, *qy, *qz] == [0.0; 6] && qw.abs() == 1.0 {
        return Ok(());
    }
    invalid(
        format!(
            "the sensor is at [{tx}, {ty}, {tz}], turned by the quaternion [{qw}, {qx}, {qy}, {qz}]"
        ),
        "Store the points in the sensor's own frame, with VIEWPOINT 0 0 0 1 0 0 0",
    )
}
