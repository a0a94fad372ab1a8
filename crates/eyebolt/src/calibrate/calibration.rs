//! A calibration, trusted or not.

use super::error::ErrorEstimate;
use super::reason::Verdict;
use super::still_part::StillPart;
use super::unknown_parts::UnknownPart;
use crate::refine::{Agreement, CameraMoved, ConfigurationOutcome, total};
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::Refinement;

/// A calibration, trusted or not.
#[derive(Clone, Debug)]
pub struct Calibration {
    /// The answer, for the depth optical frame; `None` if nothing was found at all.
    pub camera_from_base: Option<Transform<Camera, Base>>,
    /// What the last refinement says, in the observations' own camera frame.
    pub refinement: Option<Refinement>,
    /// One for each configuration of the observations.
    pub configurations: Vec<ConfigurationOutcome>,
    /// When the camera was found to have moved, in order of time: the answer is where it was last.
    pub camera_moved: Vec<CameraMoved>,
    /// Parts that move with a link and are not in the description.
    pub unknown_parts: Vec<UnknownPart>,
    /// Where the links that never move may be; `None` if nothing turns.
    pub still_part: Option<StillPart>,
    /// How far off the answer is expected to be.
    pub error: Option<ErrorEstimate>,
    /// Whether to use it.
    pub verdict: Verdict,
}

impl Calibration {
    /// No answer, and why.
    pub fn without_pose(verdict: Verdict) -> Self {
        let configurations = Vec::new();
        let (camera_moved, unknown_parts) = (Vec::new(), Vec::new());
        Self {
            camera_from_base: None,
            refinement: None,
            configurations,
            camera_moved,
            unknown_parts,
            still_part: None,
            error: None,
            verdict,
        }
    }

    /// How all pixels of the configurations used agree with the answer.
    pub fn agreement(&self) -> Option<Agreement> {
        let views: Vec<_> = self.configurations.iter().filter_map(|c| c.agreement).collect();
        (!views.is_empty()).then(|| total(&views))
    }
}
