//! `eyebolt evaluate`.

use crate::Ending;
use crate::output;
use anyhow::Result;
use eyebolt::evaluate::{Evaluation, evaluate};
use eyebolt::export::SavedCalibration;
use eyebolt_recording::read_truth;
use serde::Serialize;
use std::path::PathBuf;

/// Options of `eyebolt evaluate`.
///
/// Refused calibrations are evaluated too: whether they were refused is part of the answer.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Recording that `eyebolt simulate` made, or its truth.json
    session: PathBuf,
    /// Calibration made from it
    calibration: PathBuf,
    /// One line of JSON
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Line {
    #[serde(flatten)]
    evaluation: Evaluation,
    trusted: bool,
    /// Against the poses that the camera had later, if it was bumped.
    #[serde(skip_serializing_if = "<[Evaluation]>::is_empty")]
    after_bump: Vec<Evaluation>,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    let truth = read_truth(&arguments.session)?;
    let calibration = SavedCalibration::read(&arguments.calibration)?;
    let trusted = calibration.refused().is_none();
    let base_from_camera = calibration.base_from_camera(true)?;
    let evaluations = evaluate(&base_from_camera.inverse(), &truth);
    let (first, after) = evaluations.split_first().expect("the first pose is always known");
    if arguments.json {
        let line = Line { evaluation: *first, trusted, after_bump: after.to_vec() };
        output::deliver(format!("{}\n", serde_json::to_string(&line)?).as_bytes())?;
    } else {
        output::say(&text(first, after, trusted));
    }
    Ok(Ending::Done)
}

fn text(first: &Evaluation, after: &[Evaluation], trusted: bool) -> String {
    let row = |evaluation: &Evaluation| {
        format!(
            "{:.2} mm and {:.3} deg off in camera_from_base; the camera itself {:.2} mm",
            evaluation.translation_mm, evaluation.rotation_deg, evaluation.camera_position_mm
        )
    };
    let verdict = if trusted { "trusted" } else { "REFUSED" };
    let mut text = format!("{verdict}: {}", row(first));
    for later in after {
        text += &format!("\nagainst where the camera was bumped to: {}", row(later));
    }
    text
}
