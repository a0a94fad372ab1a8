//! What a view came to.

use super::moved::Moved;
use crate::answer::Pose;
use serde::Serialize;

/// Why a view neither counts nor resets anything.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum WhyNot {
    /// A joint that carries a link has no position.
    Unplaced,
    /// Too little of the arm is seen.
    TellsNothing,
    /// The arm rested there before, and looks the same.
    SeenBefore,
}

/// What one view came to.
#[derive(Clone, Debug, Serialize)]
pub struct ViewReport {
    /// The frame's name.
    pub frame: String,
    /// Whether it counts.
    pub counts: bool,
    /// Why it does not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why_not: Option<WhyNot>,
    /// Median distance of the arm's points from the posed arm as this view has it, millimetres.
    pub residual_mm: Option<f64>,
    /// The same when the calibration was made.
    pub expected_residual_mm: Option<f64>,
    /// Share of the pixels where the arm should be that show what is behind it.
    pub seen_through_share: f64,
    /// How far this view alone has the arm from where it should be, in squared standard deviations for each of six parts:
    /// about one if nothing moved.
    pub surprise: Option<f64>,
    /// Decimal logarithm of the evidence that something moved, against the limit: an alarm from zero on. Absent before
    /// any view counted.
    pub log10_evidence: Option<f64>,
    /// Whether something moved.
    pub alarm: bool,
    /// How far the arm is from where the calibration has it.
    pub drift: Option<Drift>,
    /// With an alarm, what moved, likeliest first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub moved: Vec<Moved>,
    /// With an alarm that is not a joint's, the pose that fits the views since; nothing applies it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proposed_camera_from_base: Option<Pose>,
}

/// How far the arm is from where the calibration has it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Drift {
    /// At the middle of the workspace, millimetres.
    pub translation_mm: f64,
    /// Root mean square error of that, millimetres: of the views, and of the calibration it is measured from.
    pub translation_sigma_mm: f64,
    /// Degrees.
    pub rotation_deg: f64,
    /// Root mean square error of that, degrees.
    pub rotation_sigma_deg: f64,
    /// Over how many views.
    pub views: usize,
    /// Translation at the middle of the workspace along the camera's axes, millimetres.
    pub translation_in_camera_mm: [f64; 3],
    /// Rotation vector along them, degrees.
    pub rotation_in_camera_deg: [f64; 3],
}
