//! What was found out about camera, arm and description on the way.

use crate::calibrate::{Calibration, Deviation};
use crate::pipeline::Outcome;
use crate::refine::CameraMoved;
use nalgebra::Point3;
use serde::Serialize;
use std::fmt;

/// When the camera moved, and by how much.
#[derive(Clone, Debug, Serialize)]
pub struct CameraMovedBetween {
    /// The last frame before.
    pub after_frame: String,
    /// The first frame after.
    pub before_frame: String,
    /// How far the middle of the workspace moved in the camera's frame, millimetres.
    pub translation_mm: f64,
    /// By what angle, degrees.
    pub rotation_deg: f64,
}

/// A part that is not in the robot description.
#[derive(Clone, Debug, Serialize)]
pub struct Part {
    /// The link that it moves with.
    pub link: String,
    /// Its longest side, about, metres.
    pub size_m: f64,
}

/// A link that is longer than described.
#[derive(Clone, Debug, Serialize)]
pub struct LinkLength {
    /// The joint at its end.
    pub joint: String,
    /// How much farther that joint is from the one before it, millimetres.
    pub longer_mm: f64,
}

/// How far true intrinsics are from those stated.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct StatedIntrinsics {
    /// The true focal lengths are so much longer, percent.
    pub focal_percent: f64,
    /// Where the true principal point is from the one stated, pixels.
    pub centre_px: [f64; 2],
}

/// A prior this wide was given to what stood out; all else is taken at its word.
const LENGTH_STOOD_OUT_M: f64 = 1e-3;
const INTRINSIC_STOOD_OUT: f64 = 1e-3;

pub(super) fn camera_moved(calibration: &Calibration) -> Vec<CameraMovedBetween> {
    let workspace = calibration.error.as_ref().map_or(Point3::origin(), |e| e.workspace_in_base);
    let between = |moved: &CameraMoved| {
        let (earlier, later) = (&moved.earlier_camera_from_base, &moved.later_camera_from_base);
        let Deviation { translation_m, rotation_rad } =
            Deviation::between(earlier, later, &workspace);
        let frames = |index: usize| calibration.configurations.get(index).map(|c| &c.frames);
        CameraMovedBetween {
            after_frame: frames(moved.before).and_then(|f| f.last()).cloned().unwrap_or_default(),
            before_frame: frames(moved.after).and_then(|f| f.first()).cloned().unwrap_or_default(),
            translation_mm: 1e3 * translation_m,
            rotation_deg: rotation_rad.to_degrees(),
        }
    };
    calibration.camera_moved.iter().map(between).collect()
}

pub(super) fn unknown_parts(calibration: &Calibration) -> Vec<Part> {
    let parts = calibration.unknown_parts.iter();
    parts.map(|part| Part { link: part.link.clone(), size_m: part.size_m }).collect()
}

pub(super) fn link_lengths(outcome: &Outcome) -> Vec<LinkLength> {
    let (Some(observations), Some(refinement)) =
        (&outcome.observations, &outcome.calibration.refinement)
    else {
        return Vec::new();
    };
    let lengths = refinement.joint_offsets.lengths_m.iter().zip(&refinement.offset_prior.lengths_m);
    let joints = observations.arm.joints().iter().zip(lengths);
    let stood_out = joints.filter(|(_, (_, prior))| **prior > LENGTH_STOOD_OUT_M);
    let told = stood_out.map(|(joint, (longer, _))| LinkLength {
        joint: joint.name.clone(),
        longer_mm: 1e3 * longer,
    });
    told.collect()
}

pub(super) fn intrinsics_offset(outcome: &Outcome) -> Option<StatedIntrinsics> {
    let (observations, refinement) =
        (outcome.observations.as_ref()?, outcome.calibration.refinement.as_ref()?);
    let prior = &refinement.offset_prior.intrinsics;
    prior.iter().any(|prior| *prior > INTRINSIC_STOOD_OUT).then(|| {
        let ([x, y], camera) = (refinement.intrinsics.centre, &observations.camera);
        StatedIntrinsics {
            focal_percent: 100.0 * refinement.intrinsics.focal,
            centre_px: [x * camera.fx(), y * camera.fy()],
        }
    })
}

impl fmt::Display for CameraMovedBetween {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the camera moved between frame {} and frame {} by {:.0} mm and {:.1} degrees: the answer is \
             where it was afterwards",
            self.after_frame, self.before_frame, self.translation_mm, self.rotation_deg
        )
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "a part of about {:.2} m on {} is not in the description: left out of account",
            self.size_m, self.link
        )
    }
}

impl fmt::Display for LinkLength {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "joint {} seems to be {:+.1} mm farther from the one before it than described: allowed for",
            self.joint, self.longer_mm
        )
    }
}

impl fmt::Display for StatedIntrinsics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y] = self.centre_px;
        write!(
            f,
            "the intrinsics seem to be off: focal length {:+.1} %, principal point {x:+.1}, {y:+.1} px: \
             allowed for",
            self.focal_percent
        )
    }
}
