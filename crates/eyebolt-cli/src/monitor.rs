//! `eyebolt monitor`.

mod lines;

use crate::calibrate;
use crate::ending::Ending;
use crate::front::{Front, Terminal};
use crate::inputs::{CacheArguments, RecordingArguments, RobotArguments, positive, use_threads};
use crate::output;
use crate::robots::told;
use anyhow::{Result, bail};
use eyebolt::export::SavedCalibration;
use eyebolt::monitor::{Known, Rate, ViewReport, Watched, watch};
use eyebolt::pipeline::Failure;
use eyebolt::record::{RecordError, RecordOptions, observe};
use eyebolt_recording::Recording;
use std::path::PathBuf;

/// Options of `eyebolt monitor`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The calibration to watch
    calibration: PathBuf,
    #[command(flatten)]
    recording: RecordingArguments,
    #[command(flatten)]
    robot: RobotArguments,
    /// False alarms that are allowed in an hour, on average
    #[arg(long, value_name = "NUMBER", default_value_t = Rate::default().false_alarms_per_hour, value_parser = positive)]
    false_alarms_per_hour: f64,
    /// How many resting views there are in an hour
    #[arg(long, value_name = "NUMBER", default_value_t = Rate::default().views_per_hour, value_parser = positive)]
    views_per_hour: f64,
    /// How many frames of each rest are looked at
    #[arg(long, value_name = "NUMBER", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..))]
    per_rest: u16,
    /// Watch a calibration that was refused, too
    #[arg(long)]
    even_if_refused: bool,
    /// Find the arm's pixels without the recording's masks
    #[arg(long)]
    no_masks: bool,
    /// JSON, a line for each view, instead of text
    #[arg(long)]
    json: bool,
    /// Threads to use; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(flatten)]
    cache: CacheArguments,
}

/// Of the recording's configurations, as many as tell the camera and the noise of its depth.
const FEW: usize = 2;

/// Why watching ended early.
enum Ended {
    Record(RecordError),
    Output(anyhow::Error),
}

impl From<RecordError> for Ended {
    fn from(error: RecordError) -> Self {
        Self::Record(error)
    }
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    let calibration = SavedCalibration::read(&arguments.calibration)?;
    let recording = || named(arguments);
    let mut last = None;
    let (mut views, mut counted) = (0, 0);
    let alarm = of(arguments, &calibration, recording, &Terminal, &mut |report| {
        let line = match arguments.json {
            true => serde_json::to_string(&report)?,
            false => lines::view(&report),
        };
        output::deliver(format!("{line}\n").as_bytes())?;
        views += 1;
        counted += usize::from(report.counts);
        last = Some(report);
        Ok(())
    })?;
    if !arguments.json {
        output::say(&lines::ending(last.as_ref(), views, counted));
    }
    Ok(if alarm { Ending::Refused } else { Ending::Done })
}

/// The recording that `arguments` name.
pub(crate) fn named(arguments: &Arguments) -> Result<Recording<'static>> {
    arguments.recording.open_of(&arguments.robot)
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
    let path = &arguments.recording.recording;
    let recording = recording()?;
    let arm = told(arguments.robot.arm(path, &recording)?, front);
    let recording = arguments.robot.noted(recording, &arm)?;
    if calibration.base_frame.as_str() != arm.base_name() {
        bail!(
            "{}: frames.base: the calibration is of {}, but the arm's base is {}. Name it with --base, or give \
             another calibration",
            calibration.file(),
            calibration.base_frame.as_str(),
            arm.base_name()
        );
    }
    let options = RecordOptions { use_masks: !arguments.no_masks, most_configurations: FEW };
    let source = recording.source();
    let failed = |error| calibrate::named(Failure::Record(error), path);
    let observations = observe(source, &arm, &arguments.cache.open(), &options).map_err(failed)?;
    let known = Known::new(calibration, &observations, arguments.even_if_refused)?;
    let rate = Rate {
        views_per_hour: arguments.views_per_hour,
        false_alarms_per_hour: arguments.false_alarms_per_hour,
    };
    let watched = Watched {
        source,
        arm: &arm,
        observations: &observations,
        options: &options,
        per_rest: usize::from(arguments.per_rest),
    };
    let each = |report: ViewReport| each(report).map_err(Ended::Output);
    match watch::<Ended>(&watched, known, &rate, each) {
        Err(Ended::Record(error)) => Err(failed(error)),
        Err(Ended::Output(error)) => Err(error),
        Ok(alarm) => Ok(alarm),
    }
}
