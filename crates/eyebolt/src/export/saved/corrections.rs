//! What a calibration file says of the recording it was made of: what is to be corrected in it.

use super::field::REMEDY;
use crate::export::error::ExportError;
use serde::Deserialize;

/// What a calibration found to be off in what was recorded and described.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Corrections {
    /// Joints, and how much farther they stand than they say, radians.
    pub joint_offsets_rad: Vec<(String, f64)>,
    /// Joints, and how much farther they are from the joint before them than described, metres.
    pub link_lengths_m: Vec<(String, f64)>,
    /// True depth is so many times the depth seen, less 1.
    pub depth_scale_error: f64,
    /// The true focal lengths are so many times those stated, less 1.
    pub focal: f64,
    /// Where the true principal point is from the one stated, pixels.
    pub centre_px: [f64; 2],
    /// The camera moved, last before the frame of this name; the calibration is of what came after.
    pub camera_moved_before: Option<String>,
}

#[derive(Deserialize, Default)]
#[serde(default)]
pub(super) struct RawCorrections {
    joint_offsets: Vec<RawOffset>,
    link_lengths: Vec<RawLength>,
    depth_scale_error: Option<f64>,
    intrinsics_offset: Option<RawIntrinsics>,
    camera_moved: Vec<RawMoved>,
}

#[derive(Deserialize)]
struct RawOffset {
    joint: String,
    offset_deg: f64,
}

#[derive(Deserialize)]
struct RawLength {
    joint: String,
    longer_mm: f64,
}

#[derive(Deserialize)]
struct RawIntrinsics {
    focal_percent: f64,
    centre_px: [f64; 2],
}

#[derive(Deserialize)]
struct RawMoved {
    before_frame: String,
}

/// No calibration finds anything to be off by more.
const MOST_DEG: f64 = 180.0;
const MOST_MM: f64 = 1000.0;
const MOST_SHARE: f64 = 0.5;
const MOST_PX: f64 = 10_000.0;

impl RawCorrections {
    pub(super) fn check(self, file: &str) -> Result<Corrections, ExportError> {
        let within = |field: &str, value: f64, most: f64| match value.abs() <= most {
            true => Ok(value),
            false => {
                let problem = format!("{value} is more than {most}");
                Err(ExportError::invalid(file, field, problem, REMEDY))
            }
        };
        let offset = |raw: RawOffset| {
            let deg = within("joint_offsets.offset_deg", raw.offset_deg, MOST_DEG)?;
            Ok((raw.joint, deg.to_radians()))
        };
        let length = |raw: RawLength| {
            Ok((raw.joint, 1e-3 * within("link_lengths.longer_mm", raw.longer_mm, MOST_MM)?))
        };
        let scale = self.depth_scale_error.unwrap_or(0.0);
        let (focal, [x, y]) = self
            .intrinsics_offset
            .map_or((0.0, [0.0; 2]), |raw| (0.01 * raw.focal_percent, raw.centre_px));
        Ok(Corrections {
            joint_offsets_rad: self
                .joint_offsets
                .into_iter()
                .map(offset)
                .collect::<Result<_, ExportError>>()?,
            link_lengths_m: self
                .link_lengths
                .into_iter()
                .map(length)
                .collect::<Result<_, ExportError>>()?,
            depth_scale_error: within("depth_scale_error", scale, MOST_SHARE)?,
            focal: within("intrinsics_offset.focal_percent", focal, MOST_SHARE)?,
            centre_px: [
                within("intrinsics_offset.centre_px", x, MOST_PX)?,
                within("intrinsics_offset.centre_px", y, MOST_PX)?,
            ],
            camera_moved_before: self.camera_moved.into_iter().last().map(|raw| raw.before_frame),
        })
    }
}
