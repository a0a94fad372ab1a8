//! Camera intrinsics in the YAML files of ROS.
//!
//! Read are a `sensor_msgs/CameraInfo` message of ROS 2 (`k`, `d`) or ROS 1 (`K`, `D`), as
//! `ros2 topic echo` prints it, and the calibration files of `camera_calibration_parsers`
//! (`camera_matrix`, `distortion_coefficients`).

use crate::error::RecordingError;
use crate::file::read_text;
use crate::message::{CameraInfoMessage, Header};
use eyebolt_geometry::{Distortion, PinholeCamera};
use serde::Deserialize;
use std::path::Path;

const FIELD: &str = "camera info";

/// Intrinsics of a camera and the name of its frame.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraInfo {
    /// The intrinsics, of the picture as stored.
    pub camera: PinholeCamera,
    /// Name of the optical frame in ROS, if the file says it.
    pub frame_id: Option<String>,
}

/// The fields of all forms; those that are of no use here are not named.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Raw {
    #[serde(alias = "image_width")]
    width: Option<u32>,
    #[serde(alias = "image_height")]
    height: Option<u32>,
    #[serde(alias = "K")]
    k: Option<Vec<f64>>,
    #[serde(alias = "D")]
    d: Option<Vec<f64>>,
    #[serde(alias = "P")]
    p: Option<Vec<f64>>,
    camera_matrix: Option<RawMatrix>,
    projection_matrix: Option<RawMatrix>,
    distortion_coefficients: Option<RawMatrix>,
    distortion_model: Option<String>,
    frame_id: Option<String>,
    header: Option<RawHeader>,
}

#[derive(Debug, Deserialize)]
struct RawMatrix {
    data: Vec<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct RawHeader {
    frame_id: Option<String>,
}

impl CameraInfo {
    /// Reads the file at `path`; of several YAML documents the first.
    ///
    /// # Errors
    ///
    /// A file that cannot be read, is not YAML, lacks the size or the intrinsics, is of an
    /// uncalibrated camera, or has a lens model other than `plumb_bob` and `rational_polynomial`.
    pub fn read(path: &Path) -> Result<Self, RecordingError> {
        Self::parse(path, &read_text(path, FIELD)?)
    }

    /// As [`CameraInfo::read`]; `rectified` pictures have the intrinsics of `p`.
    pub(crate) fn read_for(path: &Path, rectified: bool) -> Result<Self, RecordingError> {
        Self::parse_for(path, &read_text(path, FIELD)?, rectified)
    }

    /// As [`CameraInfo::read`], from text; `path` is for messages.
    pub(crate) fn parse(path: &Path, text: &str) -> Result<Self, RecordingError> {
        Self::parse_for(path, text, false)
    }

    fn parse_for(path: &Path, text: &str, rectified: bool) -> Result<Self, RecordingError> {
        let mut bytes = text.as_bytes();
        let mut raw: Raw = match serde_saphyr::read(&mut bytes).next() {
            Some(Ok(raw)) => raw,
            Some(Err(error)) => {
                let error = error.without_snippet().to_string();
                return Err(invalid(path, FIELD, error, REMEDY));
            }
            None => return Err(invalid(path, FIELD, "the file is empty", REMEDY)),
        };
        if rectified {
            raw.rectify();
        }
        let camera = camera(path, &raw)?;
        let in_header = raw.header.and_then(|h| h.frame_id);
        let frame_id = in_header.or(raw.frame_id).filter(|id| !id.is_empty());
        Ok(Self { camera, frame_id })
    }
}

impl Raw {
    /// Takes the intrinsics of the rectified picture, which has no distortion left, where they are
    /// told; drivers that do not rectify leave them out or at zero.
    fn rectify(&mut self) {
        let projection = self.projection_matrix.as_ref().map(|matrix| &matrix.data);
        let p = self.p.as_ref().or(projection).map(Vec::as_slice);
        if let Some(&[fx, skew, cx, _, k10, fy, cy, _, k20, k21, k22, _]) = p
            && fx != 0.0
            && fy != 0.0
        {
            self.k = Some(vec![fx, skew, cx, k10, fy, cy, k20, k21, k22]);
            self.d = None;
            self.distortion_coefficients = None;
            self.distortion_model = None;
        }
    }
}

impl CameraInfo {
    /// From a message; `rectified` pictures have the intrinsics of `p` and no distortion left.
    ///
    /// `path` is for messages.
    pub(crate) fn from_message(
        path: &Path,
        message: &CameraInfoMessage<'_>,
        rectified: bool,
    ) -> Result<Self, RecordingError> {
        let mut raw = Raw {
            width: Some(message.width),
            height: Some(message.height),
            k: Some(message.k.to_vec()),
            d: Some(message.d.clone()),
            distortion_model: Some(message.distortion_model.to_owned()),
            ..Raw::default()
        };
        raw.p = Some(message.p.to_vec());
        if rectified {
            raw.rectify();
        }
        let camera = camera(path, &raw)?;
        let frame_id = Some(message.header.frame_id.to_owned()).filter(|id| !id.is_empty());
        Ok(Self { camera, frame_id })
    }
}

/// What a driver of `camera` would say.
pub(crate) fn camera_info_message<'a>(
    camera: &PinholeCamera,
    header: Header<'a>,
) -> CameraInfoMessage<'a> {
    let [fx, fy, cx, cy] = [camera.fx(), camera.fy(), camera.cx(), camera.cy()];
    let (distortion_model, count) = match camera.distortion() {
        Distortion::None | Distortion::PlumbBob { .. } => ("plumb_bob", 5),
        Distortion::RationalPolynomial { .. } => ("rational_polynomial", 8),
    };
    CameraInfoMessage {
        header,
        height: camera.height(),
        width: camera.width(),
        distortion_model,
        d: camera.distortion().coefficients().into_iter().take(count).collect(),
        k: [fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0],
        r: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        // A picture with distortion was not rectified, whatever its topic is called.
        p: match camera.distortion() {
            Distortion::None => [fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0],
            _ => [0.0; 12],
        },
    }
}

const REMEDY: &str = "Store what `ros2 topic echo --once` prints of the camera_info topic";

fn invalid(path: &Path, field: &str, problem: impl Into<String>, remedy: &str) -> RecordingError {
    RecordingError::invalid(path, field, problem, remedy)
}

fn camera(path: &Path, raw: &Raw) -> Result<PinholeCamera, RecordingError> {
    let missing = |field| invalid(path, field, "the field is missing", REMEDY);
    let width = raw.width.ok_or_else(|| missing("width"))?;
    let height = raw.height.ok_or_else(|| missing("height"))?;
    let (field, k) = match (&raw.k, &raw.camera_matrix) {
        (Some(k), _) => ("k", k),
        (None, Some(matrix)) => ("camera_matrix.data", &matrix.data),
        (None, None) => return Err(missing("k")),
    };
    let &[fx, skew, cx, k10, fy, cy, k20, k21, k22] = k.as_slice() else {
        let problem = format!("found {} numbers, expected the 9 of a 3 x 3 matrix", k.len());
        return Err(invalid(path, field, problem, REMEDY));
    };
    if fx == 0.0 || fy == 0.0 {
        let problem = format!("the focal length is {fx} x {fy}: the camera is not calibrated");
        let remedy = "Calibrate it, or take the camera_info of the topic that the depth is on";
        return Err(invalid(path, field, problem, remedy));
    }
    if [skew, k10, k20, k21, k22] != [0.0, 0.0, 0.0, 0.0, 1.0] {
        let problem = "the matrix is not [fx, 0, cx, 0, fy, cy, 0, 0, 1]";
        return Err(invalid(path, field, problem, "Write it row by row, without skew"));
    }
    let distortion = distortion(path, raw)?;
    PinholeCamera::new(width, height, fx, fy, cx, cy, distortion)
        .map_err(|error| invalid(path, FIELD, error.to_string(), REMEDY))
}

fn distortion(path: &Path, raw: &Raw) -> Result<Distortion, RecordingError> {
    let matrix = raw.distortion_coefficients.as_ref();
    let d = raw.d.as_deref().or(matrix.map(|m| m.data.as_slice())).unwrap_or(&[]);
    let model = raw.distortion_model.as_deref().unwrap_or_default();
    // Every model's own number of coefficients; plumb_bob may lack its last, k3.
    let (least, most) = match model {
        "plumb_bob" => (4, 5),
        "rational_polynomial" => (8, 8),
        // Drivers of rectified pictures leave the model out.
        "" | "none" => (0, 0),
        other => {
            let problem = format!("the lens model \"{other}\" is not supported");
            let remedy = "Supported are plumb_bob and rational_polynomial: rectify the depth, or \
                          calibrate the camera with one of these";
            return Err(invalid(path, "distortion_model", problem, remedy));
        }
    };
    if d.iter().all(|c| *c == 0.0) {
        return Ok(Distortion::None);
    }
    // Files are padded with zeros at will.
    if d.len() < least || d.iter().skip(most).any(|c| *c != 0.0) {
        let problem = format!("{} coefficients do not make a lens of model \"{model}\"", d.len());
        let remedy = "plumb_bob has 5 (k1 k2 p1 p2 k3), rational_polynomial 8 (.. k4 k5 k6)";
        return Err(invalid(path, "d", problem, remedy));
    }
    let c = |i: usize| d.get(i).copied().unwrap_or(0.0);
    Ok(match most {
        5 => Distortion::plumb_bob(std::array::from_fn(c)),
        _ => Distortion::rational_polynomial(std::array::from_fn(c)),
    })
}
