//! `eyebolt monitor`.

mod arguments;
mod lines;
#[cfg(feature = "live")]
mod live;
mod teller;

use crate::calibrate::named;
use crate::ending::Ending;
use crate::inputs::{RecordingArguments, use_threads};
use crate::robots::told;
use anyhow::Result;
pub use arguments::Arguments;
use arguments::check_base;
use eyebolt::export::SavedCalibration;
use eyebolt::monitor::{Known, Watched, watch};
use eyebolt::pipeline::Failure;
use eyebolt::record::observe;
use std::path::Path;
use teller::{Ended, Teller};

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    let calibration = SavedCalibration::read(&arguments.calibration)?;
    calibration.base_from_camera(arguments.even_if_refused)?;
    match &arguments.recording {
        Some(path) => watch_recording(arguments, path, &calibration),
        #[cfg(feature = "live")]
        None => live::watch(arguments, &calibration),
        #[cfg(not(feature = "live"))]
        None => anyhow::bail!("no recording: give one"),
    }
}

fn watch_recording(
    arguments: &Arguments,
    path: &Path,
    calibration: &SavedCalibration,
) -> Result<Ending> {
    let recording = RecordingArguments { recording: path.to_owned(), bag: arguments.bag.clone() };
    let recording = recording.open_of(&arguments.robot)?;
    let arm = told(arguments.robot.arm(path, &recording)?);
    check_base(calibration, &arm)?;
    let recording = arguments.robot.noted(recording, &arm)?;
    let options = arguments.options();
    let source = recording.source();
    let failed = |error| named(Failure::Record(error), path);
    let observations = observe(source, &arm, &arguments.cache.open(), &options).map_err(failed)?;
    let known = Known::new(calibration, &observations, arguments.even_if_refused)?;
    let watched = Watched {
        source,
        arm: &arm,
        observations: &observations,
        options: &options,
        per_rest: usize::from(arguments.per_rest),
    };
    let mut teller = Teller::new(arguments.json);
    let ended = watch::<Ended>(&watched, known, &arguments.rate(), |report| teller.tell(report));
    let alarm = ended.map_err(|ended| ended.into_error(failed))?;
    Ok(teller.end(alarm))
}
