//! A calibration from a file, applied to a recording.

use crate::export::{ExportError, SavedCalibration};
use crate::observations::Observations;
use eyebolt_registration::{IntrinsicsOffset, JointOffsets, Start};

/// Where `calibration` has the arm in the images of `observations`, with all that it found to be off.
///
/// # Errors
///
/// As [`SavedCalibration::base_from_camera`].
pub fn start(
    calibration: &SavedCalibration,
    observations: &Observations,
    even_if_refused: bool,
) -> Result<Start, ExportError> {
    let camera_from_base = calibration.base_from_camera(even_if_refused)?.inverse();
    let corrections = calibration.corrections();
    let mut joint_offsets = JointOffsets::default();
    let numbers = joint_offsets.rad.iter_mut().zip(&mut joint_offsets.lengths_m);
    for (joint, (rad, length_m)) in observations.arm.joints().iter().zip(numbers) {
        *rad = found(&corrections.joint_offsets_rad, &joint.name);
        *length_m = found(&corrections.link_lengths_m, &joint.name);
    }
    let [x, y] = corrections.centre_px;
    let camera = &observations.camera;
    let centre = [x / camera.fx(), y / camera.fy()];
    Ok(Start {
        joint_offsets,
        nuisances: [corrections.depth_scale_error, 0.0],
        intrinsics: IntrinsicsOffset { focal: corrections.focal, centre },
        ..Start::from(observations.optical_from_camera.inverse() * camera_from_base)
    })
}

fn found(by_joint: &[(String, f64)], joint: &str) -> f64 {
    by_joint.iter().find(|(name, _)| name == joint).map_or(0.0, |(_, value)| *value)
}
