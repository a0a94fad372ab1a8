//! `eyebolt live`.

mod arguments;
mod calibrator;
pub mod domain;
mod keyboard;
mod lines;
mod listening;
mod publish;
mod recorder;

use crate::calibrate::{self, WayArguments};
use crate::ending::Ending;
use crate::inputs::RecordingArguments;
use crate::output::{self, Destination, STDOUT};
use crate::progress::Interrupt;
use anyhow::{Result, bail};
pub use arguments::Arguments;
use calibrator::Calibrator;
use keyboard::Keyboard;
use listening::{Ended, Listening};
use recorder::Recorder;
use std::path::Path;

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    if arguments.output == Path::new(STDOUT) {
        bail!(
            "--output: a session needs a file for its calibration. Name one, such as calibration.json"
        );
    }
    Destination::new(&arguments.output, arguments.force)?;
    arguments.robot.check_named()?;
    let session = arguments.session.clone();
    let session = session.unwrap_or_else(|| arguments.output.with_file_name("session.mcap"));
    output::refuse_existing(&session, arguments.force)?;
    let bus = arguments.domain.join(arguments.bag.topics())?;
    let recorder = Recorder::new(&session, arguments.force)?;
    let interrupt = Interrupt::new()?;
    output::say(&lines::beginning(&arguments.domain, &session, &arguments.goal));
    let calibrator = Calibrator::start(
        &session,
        (arguments.bag.options_of(&arguments.robot), arguments.robot.clone()),
        (arguments.cache.open(), arguments.limits.limits(), arguments.seed),
    )?;
    let keyboard = Keyboard::listen()?;
    let mut listening = Listening::new(arguments, &bus, recorder, calibrator)?;
    let ended = listening.run(&keyboard, &interrupt)?;
    let taken = listening.finish()?;
    if taken < eyebolt_live::FEWEST {
        bail!(
            "{}: {taken} configurations are too few to calibrate: {} are the least. What came in is there",
            session.display(),
            eyebolt_live::FEWEST
        );
    }
    let session = RecordingArguments { recording: session, bag: arguments.bag.clone() };
    let ending = calibrate::run(&calibrate::Arguments::of_session(
        (session, arguments.robot.clone()),
        (arguments.output.clone(), arguments.report.clone()),
        WayArguments::plain(arguments.limits.clone(), arguments.seed, arguments.cache.clone()),
        arguments.force,
    ))?;
    if ended == Ended::Asked {
        output::say(&format!("ended before the goal of {} was met", arguments.goal));
    }
    if matches!(ending, Ending::Done) && !arguments.no_tf && interrupt.check().is_ok() {
        publish::until_ended(&bus, &arguments.output, &keyboard, &interrupt)?;
    }
    Ok(ending)
}
