//! A calibration against the truth of a simulation.

use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_recording::Truth;
use serde::Serialize;

/// How far a calibration is from the truth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Evaluation {
    /// Distance between the translations of `camera_from_base`: how far the base is from where the
    /// camera is said to have it, millimetres.
    pub translation_mm: f64,
    /// Angle of the rotation between the two, degrees.
    pub rotation_deg: f64,
    /// Distance between the translations of `base_from_camera`: how far the camera is from where
    /// the base is said to have it, millimetres.
    pub camera_position_mm: f64,
}

impl Evaluation {
    /// Of `camera_from_base` against `truth`.
    pub fn of(camera_from_base: &Transform<Camera, Base>, truth: &Transform<Camera, Base>) -> Self {
        let (translation_m, rotation) = camera_from_base.distance_to(truth);
        let (camera_m, _) = camera_from_base.inverse().distance_to(&truth.inverse());
        Self {
            translation_mm: 1e3 * translation_m,
            rotation_deg: rotation.to_degrees(),
            camera_position_mm: 1e3 * camera_m,
        }
    }
}

/// Of `camera_from_base` against each pose that the camera had, in order of time.
pub fn evaluate(camera_from_base: &Transform<Camera, Base>, truth: &Truth) -> Vec<Evaluation> {
    let later = truth.camera_from_base_after.iter().map(|moved| &moved.camera_from_base);
    let poses = std::iter::once(&truth.camera_from_base).chain(later);
    poses.map(|pose| Evaluation::of(camera_from_base, pose)).collect()
}
