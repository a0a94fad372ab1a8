//! A calibration by a marker, as the paper's baseline.

use super::calibration::Evaluation;
use super::scores::{Calibrated, TAG};
use super::session::{EvaluateError, Reference};
use crate::markers::{EyeToHand, MarkerRequest, calibrate, observe};
use crate::pipeline::Request;
use crate::progress::Progress;
use eyebolt_markers::Target;

/// How far the calibration by `target` alone is off in the recording of `request`.
///
/// # Errors
///
/// What cannot be read or does not fit; no colour pictures; cancelled.
pub fn by_marker(
    request: &Request<'_>,
    reference: &Reference,
    target: &Target,
    progress: &dyn Progress,
) -> Result<Calibrated, EvaluateError> {
    let marker = MarkerRequest {
        source: request.source,
        arm: request.arm,
        target: target.clone(),
        limits: request.limits,
        most_configurations: request.options.most_configurations,
    };
    let observations = observe(&marker, progress)?;
    let found = calibrate::<EyeToHand>(&observations, &request.limits);
    let off = found.camera_from_root.map(|pose| Evaluation::of(&pose, &reference.camera_from_base));
    Ok(Calibrated { method: TAG, off, trusted: found.reasons.is_empty() })
}
