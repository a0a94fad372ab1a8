//! A file that says where the camera is, to centimetres and degrees: a calibration, or a few lines of JSON.

use super::camera::{RoughCamera, USUAL_RANGE_M};
use super::request::Calibrated;
use crate::answer::SCHEMA;
use crate::calibrate::{Deviation, expected_of};
use crate::export::{ExportError, MAX_CALIBRATION_BYTES, SavedCalibration, read_text};
use eyebolt_geometry::{Base, Camera, Distortion, PinholeCamera, Transform};
use serde::Deserialize;
use std::path::Path;

/// What a camera's file says.
#[derive(Clone, Debug)]
pub struct CameraFile {
    /// The camera.
    pub camera: RoughCamera,
    /// The whole calibration, where the file is one.
    pub calibration: Option<SavedCalibration>,
    /// How far off that expects to be, where it says so.
    pub calibrated: Option<Calibrated>,
}

/// What is wrong with a camera's file.
#[derive(Debug, thiserror::Error)]
pub enum CameraFileError {
    /// A field that is not there or cannot be right.
    #[error(
        "{file}: {field}: {problem}. Give a calibration of eyebolt, or JSON with camera_from_base (translation_m, \
         rotation_xyzw) and intrinsics (width, height, fx, fy, cx, cy)"
    )]
    Field {
        /// The file.
        file: String,
        /// The field, or the place in the file.
        field: String,
        /// What was found there.
        problem: String,
    },
    /// It is a calibration, and not one to go by.
    #[error(transparent)]
    Calibration(#[from] ExportError),
}

#[derive(Deserialize)]
struct Raw {
    schema: Option<String>,
    camera_from_base: Option<RawPose>,
    intrinsics: Option<RawIntrinsics>,
    range_m: Option<[f64; 2]>,
}

#[derive(Deserialize)]
struct RawPose {
    translation_m: [f64; 3],
    rotation_xyzw: [f64; 4],
}

/// The lens is left out: a view is foretold to a few pixels.
#[derive(Deserialize)]
struct RawIntrinsics {
    width: u32,
    height: u32,
    fx: f64,
    fy: f64,
    cx: f64,
    cy: f64,
}

/// Images of more pixels in a row or a column are none.
const MOST_PIXELS: u32 = 20_000;
/// No camera that sees an arm is farther from its base, metres.
const FARTHEST_M: f64 = 100.0;

impl CameraFile {
    /// Reads the file at `path`.
    ///
    /// # Errors
    ///
    /// A file that cannot be read, and what [`Self::parse`] reports.
    pub fn read(path: &Path, even_if_refused: bool) -> Result<Self, CameraFileError> {
        let text = read_text(path, MAX_CALIBRATION_BYTES)?;
        Self::parse(&path.display().to_string(), &text, even_if_refused)
    }

    /// Reads `text`, the content of `file`.
    ///
    /// # Errors
    ///
    /// Text that is neither form, numbers that make no camera, a calibration that was refused, unless `even_if_refused`.
    pub fn parse(file: &str, text: &str, even_if_refused: bool) -> Result<Self, CameraFileError> {
        let wrong = |field: &str, problem: String| CameraFileError::Field {
            file: file.to_owned(),
            field: field.to_owned(),
            problem,
        };
        let raw: Raw = serde_json::from_str(text).map_err(|error| {
            wrong(&format!("line {}, column {}", error.line(), error.column()), error.to_string())
        })?;
        let calibration = match raw.schema.as_deref() {
            Some(SCHEMA) => Some(SavedCalibration::parse(file, text)?),
            _ => None,
        };
        let camera_from_base = match (&calibration, raw.camera_from_base) {
            (Some(calibration), _) => calibration.base_from_camera(even_if_refused)?.inverse(),
            (None, Some(pose)) => pose.checked().map_err(|p| wrong("camera_from_base", p))?,
            (None, None) => {
                return Err(wrong("camera_from_base", "the field is missing".to_owned()));
            }
        };
        let intrinsics =
            raw.intrinsics.ok_or_else(|| wrong("intrinsics", "the field is missing".to_owned()))?;
        let camera = intrinsics.checked().map_err(|problem| wrong("intrinsics", problem))?;
        let range_m = raw.range_m.unwrap_or(USUAL_RANGE_M);
        if !(range_m[0] >= 0.0 && range_m[1] > range_m[0]) {
            return Err(wrong(
                "range_m",
                "not the least and the greatest depth, metres".to_owned(),
            ));
        }
        Ok(Self {
            calibrated: calibration.as_ref().and_then(|c| calibrated(c, &camera_from_base)),
            calibration,
            camera: RoughCamera { camera, camera_from_base, range_m },
        })
    }
}

fn calibrated(
    calibration: &SavedCalibration,
    camera_from_base: &Transform<Camera, Base>,
) -> Option<Calibrated> {
    let told = calibration.uncertainty();
    let (covariance, workspace_in_base) = (told.covariance?, told.workspace_in_base?);
    let expected: Deviation = expected_of(&covariance, camera_from_base, &workspace_in_base);
    Some(Calibrated { expected, covariance, workspace_in_base })
}

impl RawPose {
    fn checked(self) -> Result<Transform<Camera, Base>, String> {
        let length = self.rotation_xyzw.iter().map(|q| q * q).sum::<f64>().sqrt();
        let is_unit = (length - 1.0).abs() <= 0.02;
        if !is_unit {
            return Err(format!("rotation_xyzw: its length is {length}, not 1"));
        }
        if self.translation_m.iter().any(|metres| metres.abs() > FARTHEST_M) {
            return Err(format!("translation_m: farther than {FARTHEST_M} m"));
        }
        Transform::from_xyzw(self.translation_m, self.rotation_xyzw)
            .ok_or_else(|| "rotation_xyzw: no rotation".to_owned())
    }
}

impl RawIntrinsics {
    fn checked(self) -> Result<PinholeCamera, String> {
        let Self { width, height, fx, fy, cx, cy } = self;
        if width.max(height) > MOST_PIXELS {
            return Err(format!("{width} x {height} pixels are more than any depth camera has"));
        }
        PinholeCamera::new(width, height, fx, fy, cx, cy, Distortion::None)
            .map_err(|error| error.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POSE: &str =
        r#""camera_from_base": {"translation_m": [0, 0, 1.2], "rotation_xyzw": [1, 0, 0, 0]}"#;
    const INTRINSICS: &str = r#""intrinsics": {"width": 640, "height": 480, "fx": 525, "fy": 525, "cx": 320, "cy": 240}"#;

    fn read(text: &str) -> Result<CameraFile, String> {
        CameraFile::parse("c.json", text, false).map_err(|error| error.to_string())
    }

    #[test]
    fn a_few_lines_are_enough() {
        let file = read(&format!("{{{POSE}, {INTRINSICS}}}")).unwrap();
        assert_eq!(file.camera.range_m, USUAL_RANGE_M);
        assert_eq!(file.camera.camera.width(), 640);
        assert!(file.calibration.is_none() && file.calibrated.is_none());
        let near = read(&format!("{{{POSE}, {INTRINSICS}, \"range_m\": [0.1, 1.0]}}")).unwrap();
        assert_eq!(near.camera.range_m, [0.1, 1.0]);
    }

    #[test]
    fn what_is_wrong_is_said_with_file_and_field() {
        let pose = |rotation: &str| {
            format!(
                r#"{{"camera_from_base": {{"translation_m": [0,0,1], "rotation_xyzw": {rotation}}}, {INTRINSICS}}}"#
            )
        };
        let wrong = [
            (format!("{{{INTRINSICS}}}"), "c.json: camera_from_base: "),
            (format!("{{{POSE}}}"), "c.json: intrinsics: "),
            (pose("[0, 0, 0, 0]"), "c.json: camera_from_base: rotation_xyzw"),
            (pose("[1, 1, 0, 0]"), "c.json: camera_from_base: rotation_xyzw"),
            (format!("{{{POSE}, {INTRINSICS}, \"range_m\": [2, 1]}}"), "c.json: range_m: "),
            (format!("{{{POSE}, {}}}", INTRINSICS.replace("640", "0")), "c.json: intrinsics: "),
            (
                format!("{{{POSE}, {}}}", INTRINSICS.replace("640", "4000000000")),
                "c.json: intrinsics",
            ),
            ("[]".to_owned(), "c.json: line 1"),
            (String::new(), "c.json: line"),
        ];
        for (text, begin) in wrong {
            let said = read(&text).unwrap_err();
            assert!(said.starts_with(begin) && said.contains("Give "), "{text}: {said}");
        }
    }
}
