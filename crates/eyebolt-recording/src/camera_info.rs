//! Camera intrinsics in the YAML files of ROS, and in the forms of others.
//!
//! Read are a `sensor_msgs/CameraInfo` message of ROS 2 (`k`, `d`) or ROS 1 (`K`, `D`), as
//! `ros2 topic echo` prints it, the calibration files of `camera_calibration_parsers`
//! (`camera_matrix`, `distortion_coefficients`), and what [`forms`] knows of others.

mod forms;
mod lens;
mod raw;
mod refusal;
mod window;

use crate::error::RecordingError;
use crate::file::read_text;
use crate::message::{CameraInfoMessage, Header};
use eyebolt_geometry::{Distortion, PinholeCamera};
use lens::distortion;
use raw::Raw;
use refusal::{FIELD, REMEDY, invalid};
use std::path::Path;
use window::Window;

/// Intrinsics of a camera and the name of its frame.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraInfo {
    /// The intrinsics, of the picture as stored.
    pub camera: PinholeCamera,
    /// Name of the optical frame in ROS, if the file says it.
    pub frame_id: Option<String>,
    /// What one of the depth's integers is, metres, if the file says it.
    pub depth_unit_m: Option<f64>,
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

    /// As [`CameraInfo::read`], of `picture`.
    pub(crate) fn read_for(path: &Path, picture: PictureForm) -> Result<Self, RecordingError> {
        Self::parse_for(path, &read_text(path, FIELD)?, picture)
    }

    /// As [`CameraInfo::read`], from text; `path` is for messages.
    ///
    /// # Errors
    ///
    /// As of [`CameraInfo::read`], but for the file.
    pub fn parse(path: &Path, text: &str) -> Result<Self, RecordingError> {
        Self::parse_for(path, text, PictureForm::default())
    }

    fn parse_for(path: &Path, text: &str, picture: PictureForm) -> Result<Self, RecordingError> {
        let mut bytes = text.as_bytes();
        let mut raw: Raw = match serde_saphyr::read(&mut bytes).next() {
            Some(Ok(raw)) => raw,
            Some(Err(error)) => {
                let error = error.without_snippet().to_string();
                return Err(invalid(path, FIELD, error, REMEDY));
            }
            None => return Err(invalid(path, FIELD, "the file is empty", REMEDY)),
        };
        forms::normalise(path, &mut raw)?;
        let camera = camera(path, &mut raw, picture)?;
        let depth_unit_m = raw.depth_unit_m;
        let in_header = raw.header.and_then(|h| h.frame_id);
        let frame_id = in_header.or(raw.frame_id).filter(|id| !id.is_empty());
        Ok(Self { camera, frame_id, depth_unit_m })
    }
}

/// What is known of the pictures that intrinsics are of.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PictureForm {
    /// Whether they are rectified: then they have the intrinsics of `p`, and no distortion left.
    pub(crate) rectified: bool,
    /// Their width and height: they may be binned, or show a part of what the sensor sees.
    pub(crate) size: Option<(u32, u32)>,
}

impl CameraInfo {
    /// From a message about `picture`; `path` is for messages.
    pub(crate) fn from_message(
        path: &Path,
        message: &CameraInfoMessage<'_>,
        picture: PictureForm,
    ) -> Result<Self, RecordingError> {
        let camera = camera(path, &mut Raw::from(message), picture)?;
        let frame_id = Some(message.header.frame_id.to_owned()).filter(|id| !id.is_empty());
        Ok(Self { camera, frame_id, depth_unit_m: None })
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
        binning: [0; 2],
        roi: [0; 4],
        do_rectify: false,
        // A picture with distortion was not rectified, whatever its topic is called.
        p: match camera.distortion() {
            Distortion::None => [fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0],
            _ => [0.0; 12],
        },
    }
}

fn camera(
    path: &Path,
    raw: &mut Raw,
    picture: PictureForm,
) -> Result<PinholeCamera, RecordingError> {
    // Intrinsics of nothing but the rectified picture are of that one.
    if picture.rectified || raw.has_only_projection() {
        raw.rectify();
    }
    let missing = |field| invalid(path, field, "the field is missing", REMEDY);
    let width = raw.width.ok_or_else(|| missing("width"))?;
    let height = raw.height.ok_or_else(|| missing("height"))?;
    let (field, k) = raw.matrix().ok_or_else(|| missing("k"))?;
    let &[fx, skew, cx, k10, fy, cy, k20, k21, k22] = k else {
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
    let window = Window::of(raw, (width, height), picture.size);
    let ((width, height), [fx, fy, cx, cy]) = window.seen((width, height), [fx, fy, cx, cy]);
    PinholeCamera::new(width, height, fx, fy, cx, cy, distortion)
        .map_err(|error| invalid(path, FIELD, error.to_string(), REMEDY))
}
