//! Intrinsics as files and messages spell them.

use crate::message::CameraInfoMessage;
use serde::Deserialize;

/// The fields of all forms; those that are of no use here are not named.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Raw {
    #[serde(alias = "image_width")]
    pub(super) width: Option<u32>,
    #[serde(alias = "image_height")]
    pub(super) height: Option<u32>,
    #[serde(alias = "K")]
    pub(super) k: Option<Vec<f64>>,
    #[serde(alias = "D")]
    pub(super) d: Option<Vec<f64>>,
    #[serde(alias = "P")]
    pub(super) p: Option<Vec<f64>>,
    pub(super) camera_matrix: Option<RawMatrix>,
    pub(super) projection_matrix: Option<RawMatrix>,
    pub(super) distortion_coefficients: Option<RawMatrix>,
    pub(super) distortion_model: Option<String>,
    pub(super) binning_x: u32,
    pub(super) binning_y: u32,
    pub(super) roi: RawRoi,
    pub(super) frame_id: Option<String>,
    pub(super) header: Option<RawHeader>,

    // Of others than ROS; see `forms`.
    pub(super) fx: Option<f64>,
    pub(super) fy: Option<f64>,
    #[serde(alias = "ppx")]
    pub(super) cx: Option<f64>,
    #[serde(alias = "ppy")]
    pub(super) cy: Option<f64>,
    pub(super) model: Option<RawModel>,
    #[serde(alias = "distortion_coeffs")]
    pub(super) coeffs: Option<Vec<f64>>,
    pub(super) depth_scale: Option<f64>,
    pub(super) intrinsic_matrix: Option<RawNumbers>,
    pub(super) intrinsic: Option<Box<Raw>>,
    pub(super) camera_model: Option<String>,
    pub(super) intrinsics: Option<Vec<f64>>,
    pub(super) resolution: Option<[u32; 2]>,
    pub(super) cam0: Option<Box<Raw>>,
    pub(super) cam1: Option<serde::de::IgnoredAny>,

    /// What one of the depth's integers is, metres.
    #[serde(skip)]
    pub(super) depth_unit_m: Option<f64>,
}

#[derive(Debug, Deserialize)]
pub(super) struct RawMatrix {
    pub(super) data: Vec<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct RawHeader {
    pub(super) frame_id: Option<String>,
}

/// A part of the sensor, pixels of the whole.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct RawRoi {
    pub(super) x_offset: u32,
    pub(super) y_offset: u32,
    pub(super) height: u32,
    pub(super) width: u32,
}

/// A lens model, by its name or by its number in librealsense.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(super) enum RawModel {
    Number(u32),
    Name(String),
}

/// Numbers in one list, or in one for each row.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(super) enum RawNumbers {
    Flat(Vec<f64>),
    Rows(Vec<Vec<f64>>),
}

impl Raw {
    /// The intrinsics, and the field that they stand in.
    pub(super) fn matrix(&self) -> Option<(&'static str, &[f64])> {
        match (&self.k, &self.camera_matrix) {
            (Some(k), _) => Some(("k", k)),
            (None, Some(matrix)) => Some(("camera_matrix.data", &matrix.data)),
            (None, None) => None,
        }
    }

    /// The intrinsics of the rectified picture, where they are told: fx, skew, cx, fy, cy and the
    /// rest; drivers that do not rectify leave them out or at zero.
    fn projection(&self) -> Option<&[f64; 12]> {
        let matrix = self.projection_matrix.as_ref().map(|matrix| &matrix.data);
        let p: &[f64; 12] = self.p.as_ref().or(matrix)?.as_slice().try_into().ok()?;
        let [fx, _, _, _, _, fy, ..] = *p;
        (fx != 0.0 && fy != 0.0).then_some(p)
    }

    /// Whether the rectified picture has intrinsics and the one as taken none.
    pub(super) fn has_only_projection(&self) -> bool {
        let zero = self.matrix().is_none_or(|(_, k)| k.iter().all(|number| *number == 0.0));
        zero && self.projection().is_some()
    }

    /// Takes the intrinsics of the rectified picture, which has no distortion left, where they are
    /// told.
    pub(super) fn rectify(&mut self) {
        if let Some(&[fx, skew, cx, _, k10, fy, cy, _, k20, k21, k22, _]) = self.projection() {
            self.k = Some(vec![fx, skew, cx, k10, fy, cy, k20, k21, k22]);
            self.d = None;
            self.distortion_coefficients = None;
            self.distortion_model = None;
        }
    }
}

impl From<&CameraInfoMessage<'_>> for Raw {
    fn from(message: &CameraInfoMessage<'_>) -> Self {
        let [binning_x, binning_y] = message.binning;
        let [x_offset, y_offset, height, width] = message.roi;
        Self {
            width: Some(message.width),
            height: Some(message.height),
            k: Some(message.k.to_vec()),
            d: Some(message.d.clone()),
            p: Some(message.p.to_vec()),
            distortion_model: Some(message.distortion_model.to_owned()),
            binning_x,
            binning_y,
            roi: RawRoi { x_offset, y_offset, height, width },
            ..Self::default()
        }
    }
}
