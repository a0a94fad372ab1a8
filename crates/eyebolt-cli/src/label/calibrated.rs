//! The calibration that a recording is labelled by.

use crate::calibrate;
use crate::front::Front;
use anyhow::Result;
use eyebolt::answer::Answer;
use eyebolt::calibrate::Verdict;
use eyebolt::dataset::Calibrated;
use eyebolt::observations::Observations;
use eyebolt::pipeline::{self, Failure, Request};
use eyebolt::record::observe;
use std::path::Path;

/// What was seen, and a calibration of it.
pub struct Known {
    pub observations: Observations,
    /// As `eyebolt calibrate` writes it: what is in the file counts, so that every machine and every
    /// run labels by the same numbers.
    pub json: String,
    pub calibrated: Calibrated,
}

/// What `request` sees, with a calibration that is known already.
pub fn given(
    request: &Request<'_>,
    path: &Path,
    json: String,
    calibrated: Calibrated,
) -> Result<Known> {
    let observations = observe(request.source, request.arm, &request.cache, &request.options)
        .map_err(|error| calibrate::named(Failure::Record(error), path))?;
    Ok(Known { observations, json, calibrated })
}

/// What `request` sees, calibrated from nothing; the reasons if that is refused.
pub fn from_nothing(
    request: &Request<'_>,
    path: &Path,
    front: &dyn Front,
) -> Result<Result<Known, Vec<String>>> {
    let stages = front.stages()?;
    let outcome = pipeline::run(request, stages.as_ref());
    let outcome = outcome.map_err(|error| calibrate::named(error, path))?;
    drop(stages);
    let json = Answer::new(request, &outcome).to_json();
    Ok(match (outcome.calibration.verdict, outcome.observations) {
        (Verdict::Refused(reasons), _) => Err(reasons.iter().map(ToString::to_string).collect()),
        (Verdict::Trusted, Some(observations)) => {
            Ok(Known { observations, json, calibrated: Calibrated::FromNothing })
        }
        (Verdict::Trusted, None) => Err(vec!["nothing was seen of the robot".to_owned()]),
    })
}
