//! The pose in a calibration file, which is there in six spellings that must agree.

use super::field::{REMEDY, missing};
use crate::export::error::ExportError;
use eyebolt_geometry::{Base, Camera, CoordinateFrame, Transform};
use nalgebra::{Matrix4, Vector3};
use serde::Deserialize;

/// By how much the spellings of one pose may differ, metres and radians. Numbers rounded to six
/// places pass; a pose that was edited in one place, or turned about, does not.
const TOLERANCE: f64 = 2e-6;

/// Farthest that a camera can be from a base, metres: more are millimetres, or damage.
const MAX_DISTANCE_M: f64 = 1e4;

#[derive(Deserialize)]
pub(super) struct RawPose {
    translation_m: Option<[f64; 3]>,
    rotation_xyzw: Option<[f64; 4]>,
    matrix: Option<[[f64; 4]; 4]>,
}

/// The pose that `there` (camera from base) and `back` both tell; `None` where there is none.
pub(super) fn agreed(
    file: &str,
    there: Option<RawPose>,
    back: Option<RawPose>,
) -> Result<Option<Transform<Base, Camera>>, ExportError> {
    let (there, back) = match (there, back) {
        (None, None) => return Ok(None),
        (Some(_), None) => return Err(missing(file, "base_from_camera")),
        (None, Some(_)) => return Err(missing(file, "camera_from_base")),
        (Some(there), Some(back)) => (there, back),
    };
    let camera_from_base: Transform<Camera, Base> = there.check(file, "camera_from_base")?;
    let base_from_camera: Transform<Base, Camera> = back.check(file, "base_from_camera")?;
    if !alike(&camera_from_base.inverse(), &base_from_camera) {
        let problem = "it is not the inverse of base_from_camera";
        return Err(ExportError::invalid(file, "camera_from_base", problem, REMEDY));
    }
    Ok(Some(base_from_camera))
}

fn alike<A: CoordinateFrame, B: CoordinateFrame>(a: &Transform<A, B>, b: &Transform<A, B>) -> bool {
    let (distance_m, angle_rad) = a.distance_to(b);
    // An angle from the other frame's origin moves this one's by its distance.
    let reach_m = 1.0 + a.translation_m().norm();
    distance_m <= TOLERANCE * reach_m && angle_rad <= 2.0 * TOLERANCE
}

impl RawPose {
    fn check<A: CoordinateFrame, B: CoordinateFrame>(
        &self,
        file: &str,
        field: &str,
    ) -> Result<Transform<A, B>, ExportError> {
        let wrong = |part: &str, problem: String| {
            ExportError::invalid(file, format!("{field}.{part}"), problem, REMEDY)
        };
        let absent = |part: &str| missing(file, &format!("{field}.{part}"));
        let translation_m = self.translation_m.ok_or_else(|| absent("translation_m"))?;
        let rotation_xyzw = self.rotation_xyzw.ok_or_else(|| absent("rotation_xyzw"))?;
        let matrix = self.matrix.ok_or_else(|| absent("matrix"))?;
        // JSON has no NaN.
        if Vector3::from(translation_m).norm() > MAX_DISTANCE_M {
            return Err(wrong("translation_m", format!("farther than {MAX_DISTANCE_M} m")));
        }
        let length = rotation_xyzw.iter().map(|q| q * q).sum::<f64>().sqrt();
        let is_unit = (length - 1.0).abs() <= TOLERANCE;
        if !is_unit {
            return Err(wrong("rotation_xyzw", format!("its length is {length}, not 1")));
        }
        let spelled = Transform::from_xyzw(translation_m, rotation_xyzw)
            .ok_or_else(|| wrong("rotation_xyzw", "no rotation".to_owned()))?;
        let matrix = Matrix4::from_row_slice(matrix.as_flattened());
        // The entries of a rotation change by up to twice what those of its quaternion do.
        let agrees = (matrix - spelled.matrix()).amax() <= 4.0 * TOLERANCE;
        if !agrees {
            let problem = "it is not the matrix of translation_m and rotation_xyzw".to_owned();
            return Err(wrong("matrix", problem));
        }
        Ok(spelled)
    }
}
