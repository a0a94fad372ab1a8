//! What is said of one recording.

use super::name::Listed;
use crate::answer::Answer;
use crate::calibrate::Verdict;
use crate::study::Refusal;
use serde::{Deserialize, Serialize};

/// How the calibration of a recording ended: a line of `batch.jsonl`. It has no times, so that it is the same whenever and
/// wherever it is made.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Line {
    /// In the names of its files.
    pub name: String,
    /// Path of the recording, as it was given.
    pub recording: String,
    /// How it ended.
    pub ending: Ending,
    /// File of the calibration in the batch's folder.
    pub calibration: Option<String>,
    /// File of the report in the batch's folder.
    pub report: Option<String>,
    /// Name of the robot in its description.
    pub robot: Option<String>,
    /// The camera in the base; of trusted answers alone.
    pub base_from_camera: Option<PoseInBase>,
    /// Error to expect at the middle of the workspace, if a pose was found.
    pub expected_error: Option<ExpectedError>,
    /// How many frames were judged.
    pub frames: usize,
    /// How many of them nothing spoke against.
    pub frames_used: usize,
    /// Why it is refused.
    pub reasons: Vec<Why>,
    /// Why there is no calibration at all.
    pub error: Option<String>,
}

/// How the calibration of a recording ended.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// With an answer to be trusted.
    Trusted,
    /// With one that is not.
    Refused,
    /// With an error.
    Failed,
}

impl Ending {
    /// As in a line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Trusted => "trusted",
            Self::Refused => "refused",
            Self::Failed => "failed",
        }
    }
}

/// Where the camera is.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct PoseInBase {
    /// Metres.
    pub translation_m: [f64; 3],
    /// Hamilton quaternion.
    pub rotation_xyzw: [f64; 4],
}

/// Error to expect.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct ExpectedError {
    /// Millimetres.
    pub translation_mm: f64,
    /// Degrees.
    pub rotation_deg: f64,
}

/// Why an answer is refused.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub struct Why {
    /// For machines: the reason's name in snake case.
    pub name: String,
    /// For people.
    pub text: String,
}

impl Line {
    /// Of a recording with an answer, which `verdict` is of, and the names of the files that were made.
    pub fn answered(
        listed: &Listed,
        answer: &Answer,
        verdict: &Verdict,
        calibration: &str,
        report: Option<&str>,
    ) -> Self {
        let (ending, reasons) = match verdict {
            Verdict::Trusted => (Ending::Trusted, Vec::new()),
            Verdict::Refused(reasons) => {
                let why = |Refusal { name, text }| Why { name, text };
                (Ending::Refused, reasons.iter().map(Refusal::of).map(why).collect())
            }
        };
        let pose = answer.base_from_camera.as_ref().filter(|_| ending == Ending::Trusted);
        Self {
            calibration: Some(calibration.to_owned()),
            report: report.map(str::to_owned),
            robot: Some(answer.robot.clone()),
            base_from_camera: pose.map(|pose| PoseInBase {
                translation_m: pose.translation_m,
                rotation_xyzw: pose.rotation_xyzw,
            }),
            expected_error: answer.expected_error.map(|size| ExpectedError {
                translation_mm: size.translation_mm,
                rotation_deg: size.rotation_deg,
            }),
            frames: answer.configurations.len(),
            frames_used: answer.configurations.iter().filter(|frame| frame.used).count(),
            reasons,
            ..Self::bare(listed, ending)
        }
    }

    /// Of a recording that cannot be calibrated.
    pub fn failed(listed: &Listed, error: String) -> Self {
        Self { error: Some(error), ..Self::bare(listed, Ending::Failed) }
    }

    fn bare(listed: &Listed, ending: Ending) -> Self {
        Self {
            name: listed.name.clone(),
            recording: listed.recording.clone(),
            ending,
            calibration: None,
            report: None,
            robot: None,
            base_from_camera: None,
            expected_error: None,
            frames: 0,
            frames_used: 0,
            reasons: Vec::new(),
            error: None,
        }
    }

    /// One line of JSON with a line break at its end.
    pub fn to_json(&self) -> String {
        let text = serde_json::to_string(self).expect("a line is plain data");
        format!("{text}\n")
    }
}
