//! One calibration against the truth.

use crate::ending::Ending;
use crate::output;
use anyhow::{Result, bail};
use eyebolt::evaluate::{Evaluation, evaluate};
use eyebolt::export::{ExportError, SavedCalibration};
use eyebolt_recording::{Truth, read_truth};
use serde::Serialize;
use std::path::Path;

#[derive(Serialize)]
pub struct Line {
    /// `null` where the calibration found no pose.
    translation_mm: Option<f64>,
    rotation_deg: Option<f64>,
    camera_position_mm: Option<f64>,
    trusted: bool,
    /// Against the poses that the camera had later, if it was bumped.
    #[serde(skip_serializing_if = "<[Evaluation]>::is_empty")]
    after_bump: Vec<Evaluation>,
}

impl Line {
    fn new(evaluations: &[Evaluation], trusted: bool) -> Self {
        let first = evaluations.first();
        Self {
            translation_mm: first.map(|first| first.translation_mm),
            rotation_deg: first.map(|first| first.rotation_deg),
            camera_position_mm: first.map(|first| first.camera_position_mm),
            trusted,
            after_bump: evaluations.iter().skip(1).copied().collect(),
        }
    }
}

/// How far `calibration`, called `name`, is from the truth of `session`.
pub fn of(session: &Path, name: &str, calibration: &SavedCalibration) -> Result<Line> {
    let (evaluations, trusted) = evaluations(&read_truth(session)?, name, calibration)?;
    Ok(Line::new(&evaluations, trusted))
}

/// Against each pose that the camera had; whether it is trusted.
fn evaluations(
    truth: &Truth,
    name: &str,
    calibration: &SavedCalibration,
) -> Result<(Vec<Evaluation>, bool)> {
    check_base(name, truth, calibration)?;
    let evaluations = match calibration.base_from_camera(true) {
        Ok(base_from_camera) => evaluate(&base_from_camera.inverse(), truth),
        Err(ExportError::NoPose { .. }) => Vec::new(),
        Err(error) => return Err(error.into()),
    };
    Ok((evaluations, calibration.refused().is_none()))
}

/// Holds the calibration at `path` against the truth of `session`: a recording of `eyebolt simulate`, or its truth.json.
pub fn run(session: &Path, path: &Path, json: bool) -> Result<Ending> {
    // That a recording is no simulated one is better told before anything else.
    let truth = read_truth(session)?;
    let calibration = SavedCalibration::read(path)?;
    let name = path.display().to_string();
    let (evaluations, trusted) = evaluations(&truth, &name, &calibration)?;
    if json {
        let line = Line::new(&evaluations, trusted);
        output::deliver(format!("{}\n", serde_json::to_string(&line)?).as_bytes())?;
    } else {
        output::say(&text(&evaluations, trusted));
    }
    Ok(Ending::Done)
}

/// Poses of different links are not to be compared.
fn check_base(name: &str, truth: &Truth, calibration: &SavedCalibration) -> Result<()> {
    let base = calibration.base_frame.as_str();
    if base != truth.base {
        bail!(
            "{name}: frames.base: the calibration is of {base:?}, and the truth of {:?}. Calibrate with \
             --base {}, or give the calibration of this recording",
            truth.base,
            truth.base
        );
    }
    Ok(())
}

fn text(evaluations: &[Evaluation], trusted: bool) -> String {
    let row = |evaluation: &Evaluation| {
        format!(
            "{:.2} mm and {:.3} deg off in camera_from_base; the camera itself {:.2} mm",
            evaluation.translation_mm, evaluation.rotation_deg, evaluation.camera_position_mm
        )
    };
    let verdict = if trusted { "trusted" } else { "REFUSED" };
    let Some((first, after)) = evaluations.split_first() else {
        return format!("{verdict}: no pose was found, so there is none to evaluate");
    };
    let mut text = format!("{verdict}: {}", row(first));
    for later in after {
        text += &format!("\nagainst where the camera was bumped to: {}", row(later));
    }
    text
}
