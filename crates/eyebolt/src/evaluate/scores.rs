//! What is counted of one recording, and of several.

use super::calibration::Evaluation;
use super::pose_errors::PoseErrors;
use crate::pose::PoseMethod;
use crate::segment::{CLASSES, Confusion};

/// Ways to the pose in one frame: what they are called, how, and whether it is refined.
pub const METHODS: [(&str, PoseMethod, bool); 5] = [
    ("RPT", PoseMethod::Rpt, false),
    ("RPT + ICP", PoseMethod::Rpt, true),
    ("KPM", PoseMethod::Kpm, false),
    ("KPM + ICP", PoseMethod::Kpm, true),
    ("fused", PoseMethod::Fused, true),
];

/// What the rows of the table of calibrations are called.
pub(super) const TAG: &str = "tag";
pub(super) const OURS: &str = "paper";
pub(super) const OURS_ICP: &str = "paper + ICP";
pub(super) const TRUE_ICP: &str = "true labels + ICP";
pub(super) const BEST: &str = "eyebolt, with the model";
pub(super) const NOTHING: &str = "eyebolt, from nothing";

/// A calibration, and how far off it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibrated {
    /// Which way it was made.
    pub method: &'static str,
    /// How far off; `None` if there was no pose.
    pub off: Option<Evaluation>,
    /// Whether it was trusted.
    pub trusted: bool,
}

/// What one model makes of recordings.
#[derive(Clone, Debug, PartialEq)]
pub struct Scores {
    /// Pixels by true and found class.
    pub labels: Confusion,
    /// Poses by [`METHODS`], with true labels.
    pub by_true_labels: [PoseErrors; METHODS.len()],
    /// With those that the networks found.
    pub by_found_labels: [PoseErrors; METHODS.len()],
    /// Calibrations of each recording.
    pub calibrations: Vec<Calibrated>,
}

impl Default for Scores {
    fn default() -> Self {
        Self {
            labels: Confusion::new(CLASSES.len()),
            by_true_labels: Default::default(),
            by_found_labels: Default::default(),
            calibrations: Vec::new(),
        }
    }
}

impl Scores {
    /// Counts what `other` counted.
    pub fn merge(&mut self, other: &Self) {
        self.labels.merge(&other.labels);
        let pairs = self.by_true_labels.iter_mut().zip(&other.by_true_labels);
        pairs.for_each(|(own, other)| own.merge(other));
        let pairs = self.by_found_labels.iter_mut().zip(&other.by_found_labels);
        pairs.for_each(|(own, other)| own.merge(other));
        self.calibrations.extend(other.calibrations.iter().cloned());
    }
}
