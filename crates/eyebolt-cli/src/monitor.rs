//! `eyebolt monitor`.

mod arguments;
mod lines;
#[cfg(feature = "live")]
mod live;
#[cfg(feature = "live")]
mod published;
mod teller;

use crate::calibrate;
use crate::ending::Ending;
use crate::front::{Front, Terminal};
use crate::inputs::{RecordingArguments, use_threads};
use crate::robots::told;
use anyhow::{Context, Result};
pub use arguments::Arguments;
use arguments::check_base;
use eyebolt::export::SavedCalibration;
use eyebolt::monitor::{Known, ViewReport, Watched, watch};
use eyebolt::pipeline::Failure;
use eyebolt::record::observe;
use eyebolt_recording::Recording;
use std::path::Path;
use teller::{Ended, Teller};

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    let calibration = SavedCalibration::read(&arguments.calibration)?;
    #[cfg(feature = "live")]
    if arguments.recording.is_none() {
        calibration.base_from_camera(arguments.even_if_refused)?;
        return live::watch(arguments, &calibration);
    }
    let recording = || named(arguments);
    let mut teller = Teller::new(arguments.json);
    let alarm =
        of(arguments, &calibration, recording, &Terminal, &mut |report| teller.tell(report))?;
    Ok(teller.end(alarm))
}

/// The recording that `arguments` name.
pub(crate) fn named(arguments: &Arguments) -> Result<Recording<'static>> {
    let path = arguments.recording.clone().context("no recording: give one")?;
    RecordingArguments { recording: path, bag: arguments.bag.clone() }.open_of(&arguments.robot)
}

/// Hands what each view of `recording` says of `calibration` to `each`; whether there is an alarm.
pub(crate) fn of<'r>(
    arguments: &Arguments,
    calibration: &SavedCalibration,
    recording: impl FnOnce() -> Result<Recording<'r>>,
    front: &dyn Front,
    each: &mut dyn FnMut(ViewReport) -> Result<()>,
) -> Result<bool> {
    calibration.base_from_camera(arguments.even_if_refused)?;
    let path = arguments.recording.as_deref().unwrap_or(Path::new("the frames"));
    let recording = recording()?;
    let arm = told(arguments.robot.arm(path, &recording)?, front);
    check_base(calibration, &arm)?;
    let recording = arguments.robot.noted(recording, &arm)?;
    let options = arguments.options();
    let source = recording.source();
    let failed = |error| calibrate::named(Failure::Record(error), path);
    let observations = observe(source, &arm, &arguments.cache.open(), &options).map_err(failed)?;
    let known = Known::new(calibration, &observations, arguments.even_if_refused)?;
    let watched = Watched {
        source,
        arm: &arm,
        observations: &observations,
        options: &options,
        per_rest: usize::from(arguments.per_rest),
    };
    let each = |report: ViewReport| each(report).map_err(Ended::Output);
    let ended = watch::<Ended>(&watched, known, &arguments.rate(), each);
    ended.map_err(|ended| ended.into_error(failed))
}
