//! Intrinsics in the forms of Kalibr, librealsense, Open3D and the BOP challenge.
//!
//! JSON is read as the YAML that it is. What could be meant in two ways is refused.

use super::raw::{Raw, RawModel, RawNumbers};
use super::refusal::{FIELD, invalid};
use crate::error::RecordingError;
use std::path::Path;

/// Names of the lens models of librealsense, by their numbers.
const REALSENSE: [&str; 6] = [
    "none",
    "modified_brown_conrady",
    "inverse_brown_conrady",
    "ftheta",
    "brown_conrady",
    "kannala_brandt4",
];

/// Fills the fields of ROS from those of others.
pub(super) fn normalise(path: &Path, raw: &mut Raw) -> Result<(), RecordingError> {
    if raw.k.is_some() || raw.camera_matrix.is_some() {
        return Ok(());
    }
    if let Some(first) = raw.cam0.take() {
        if raw.cam1.is_some() {
            let problem = "it has several cameras";
            let remedy = "Keep the section of the depth camera alone, and call it cam0";
            return Err(invalid(path, "cam1", problem, remedy));
        }
        *raw = *first;
        return kalibr(path, raw);
    }
    if raw.intrinsics.is_some() {
        return kalibr(path, raw);
    }
    // Open3D's camera has its pose beside its intrinsics.
    if let Some(intrinsic) = raw.intrinsic.take() {
        *raw = *intrinsic;
    }
    if let Some(numbers) = raw.intrinsic_matrix.take() {
        raw.k = Some(matrix(path, numbers)?);
        return Ok(());
    }
    named(path, raw)
}

/// `intrinsics: [fx, fy, cx, cy]`, `resolution: [width, height]` and a model.
fn kalibr(path: &Path, raw: &mut Raw) -> Result<(), RecordingError> {
    let model = raw.camera_model.as_deref().unwrap_or("pinhole");
    let Some(&[fx, fy, cx, cy]) = raw.intrinsics.as_deref() else {
        let problem = "these are not fx, fy, cx, cy";
        return Err(invalid(path, "intrinsics", problem, "Calibrate with the model pinhole"));
    };
    if model != "pinhole" {
        let problem = format!("the camera model \"{model}\" is not supported");
        return Err(invalid(path, "camera_model", problem, "Calibrate with the model pinhole"));
    }
    raw.k = Some(vec![fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0]);
    let size = raw.resolution.map(|[width, height]| (width, height));
    raw.width = size.map(|(width, _)| width).or(raw.width);
    raw.height = size.map(|(_, height)| height).or(raw.height);
    raw.d = raw.coeffs.take();
    Ok(())
}

/// Open3D stores matrices column by column; others rows of rows.
fn matrix(path: &Path, numbers: RawNumbers) -> Result<Vec<f64>, RecordingError> {
    let flat = match numbers {
        RawNumbers::Rows(rows) => return Ok(rows.into_iter().flatten().collect()),
        RawNumbers::Flat(flat) => flat,
    };
    match *flat.as_slice() {
        [fx, 0.0, 0.0, 0.0, fy, 0.0, cx, cy, 1.0] => {
            Ok(vec![fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0])
        }
        [_, 0.0, _, 0.0, _, _, 0.0, 0.0, 1.0] => Ok(flat),
        _ => {
            let problem = "the matrix is neither [fx, 0, 0, 0, fy, 0, cx, cy, 1], column by column, \
                           nor the same row by row";
            let remedy = "Store what Open3D's write_pinhole_camera_intrinsic writes";
            Err(invalid(path, "intrinsic_matrix", problem, remedy))
        }
    }
}

/// `fx`, `fy`, `cx` and `cy` (or `ppx` and `ppy`) by name: librealsense with a model and
/// coefficients, the `camera.json` of the BOP challenge with the depth's unit.
fn named(path: &Path, raw: &mut Raw) -> Result<(), RecordingError> {
    let (Some(fx), Some(fy), Some(cx), Some(cy)) = (raw.fx, raw.fy, raw.cx, raw.cy) else {
        return Ok(());
    };
    raw.k = Some(vec![fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0]);
    raw.d = raw.coeffs.take();
    raw.distortion_model = match raw.model.take() {
        None => raw.distortion_model.take(),
        Some(RawModel::Name(name)) => {
            // Python prints the name of the enumeration before that of the value.
            name.rsplit('.').next().map(str::to_owned)
        }
        Some(RawModel::Number(number)) => {
            let name = REALSENSE.get(number as usize).copied();
            let name = name.ok_or_else(|| {
                let problem = format!("{number} is the number of no lens model of librealsense");
                invalid(path, "model", problem, "Name the model, as in \"brown_conrady\"")
            })?;
            Some(name.to_owned())
        }
    };
    // Of the BOP challenge: millimetres of one of the depth's integers.
    if let Some(scale) = raw.depth_scale {
        if !(scale > 0.0 && scale.is_finite()) {
            let problem = format!("a depth_scale of {scale}");
            return Err(invalid(path, FIELD, problem, "Write the millimetres of one"));
        }
        raw.depth_unit_m = Some(1e-3 * scale);
    }
    Ok(())
}
