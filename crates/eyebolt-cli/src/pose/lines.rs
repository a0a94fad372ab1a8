//! What is said of the pose in one frame.

use eyebolt::pose::{ExpectedError, PoseAnswer, PoseMethod};
use eyebolt_geometry::{Camera, EndEffector, Transform};
use eyebolt_recording::UncertainPose;
use serde::Serialize;

/// A frame's line.
#[derive(Debug, Serialize)]
pub struct Line {
    frame: String,
    /// When the frame was taken, nanoseconds.
    #[serde(skip)]
    pub stamp_ns: i64,
    pub answered: bool,
    camera_from_end_effector: Option<Pose>,
    expected_error: Option<Error>,
    /// Other poses that explain the frame as well.
    alternatives: Vec<Pose>,
    method: &'static str,
    /// Whether joint states helped.
    joint_states: bool,
    reason: Option<String>,
}

/// A pose as others read it.
#[derive(Debug, Serialize)]
struct Pose {
    translation_m: [f64; 3],
    rotation_xyzw: [f64; 4],
}

/// How far off it is likely to be.
#[derive(Debug, Serialize)]
struct Error {
    translation_mm: f64,
    rotation_deg: f64,
}

impl Line {
    /// Of a frame that cannot be read.
    pub fn damaged(frame: (&str, i64), method: PoseMethod) -> Self {
        Self::none(frame, (method, false), "the frame is damaged")
    }

    fn none(
        (frame, stamp_ns): (&str, i64),
        (method, joint_states): (PoseMethod, bool),
        reason: &str,
    ) -> Self {
        Self {
            frame: frame.to_owned(),
            stamp_ns,
            answered: false,
            camera_from_end_effector: None,
            expected_error: None,
            alternatives: Vec::new(),
            method: method.name(),
            joint_states,
            reason: Some(reason.to_owned()),
        }
    }

    /// Of what was found in a frame, which has a name and a stamp, by a method and with joint states or without, by a camera that is turned against the recording's.
    pub fn of(
        frame: (&str, i64),
        how: (PoseMethod, bool),
        found: Option<PoseAnswer>,
        optical_from_camera: &Transform<Camera, Camera>,
    ) -> Self {
        let Some(found) = found else {
            return Self::none(frame, how, "too little of the end-effector is in view");
        };
        let pose = |of: &Transform<Camera, EndEffector>| {
            let of = *optical_from_camera * *of;
            Pose { translation_m: of.translation_m().into(), rotation_xyzw: of.rotation_xyzw() }
        };
        let error =
            |ExpectedError { translation_mm, rotation_deg }| Error { translation_mm, rotation_deg };
        Self {
            frame: frame.0.to_owned(),
            stamp_ns: frame.1,
            answered: found.refusal.is_none(),
            camera_from_end_effector: Some(pose(&found.camera_from_end_effector)),
            expected_error: found.expected_error.map(error),
            alternatives: found.alternatives().map(|it| pose(&it)).collect(),
            method: how.0.name(),
            joint_states: how.1,
            reason: found.refusal.map(|refusal| refusal.to_string()),
        }
    }

    /// Where the end-effector is in the camera's optical frame, if that may be relied on.
    pub fn answer(&self) -> Option<UncertainPose> {
        let Pose { translation_m, rotation_xyzw } =
            *self.camera_from_end_effector.as_ref().filter(|_| self.answered)?;
        let (mm, deg) = self
            .expected_error
            .as_ref()
            .map_or((0.0, 0.0), |error| (error.translation_mm, error.rotation_deg));
        // An error of that size, in no direction more than in others.
        let along_an_axis = f64::sqrt(3.0).recip();
        Some(UncertainPose {
            translation_m,
            rotation_xyzw,
            translation_sd_m: 1e-3 * mm * along_an_axis,
            rotation_sd: deg.to_radians() * along_an_axis,
        })
    }

    /// For programs.
    pub fn json(&self) -> String {
        serde_json::to_string(self).unwrap_or_default()
    }

    /// For a person.
    pub fn text(&self) -> String {
        let Self { frame, camera_from_end_effector, expected_error, reason, .. } = self;
        let Some(Pose { translation_m: [x, y, z], rotation_xyzw }) = camera_from_end_effector
        else {
            return format!("frame {frame}: no pose: {}", reason.as_deref().unwrap_or_default());
        };
        let [qx, qy, qz, qw] = rotation_xyzw;
        let mut text = format!(
            "frame {frame}: camera from end-effector {x:.4} {y:.4} {z:.4} m, xyzw {qx:.4} {qy:.4} {qz:.4} {qw:.4}"
        );
        if let Some(Error { translation_mm, rotation_deg }) = expected_error {
            text += &format!(", expected error {translation_mm:.1} mm {rotation_deg:.2} deg");
        }
        if let Some(reason) = reason {
            text += &format!("; not to be trusted: {reason}");
        }
        text
    }
}
