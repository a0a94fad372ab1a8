//! `eyebolt live`.

mod arguments;
mod calibrator;
pub mod domain;
mod keyboard;
mod lines;
mod listening;
mod page;
mod publish;
mod recorder;
mod scout;

use crate::calibrate;
use crate::ending::{Ending, causes};
use crate::inputs::RecordingArguments;
use crate::output::{self, Destination, STDOUT};
use crate::progress::Interrupt;
use anyhow::{Result, bail};
pub use arguments::Arguments;
use calibrator::Calibrator;
use keyboard::Keyboard;
use listening::{Ended, Listening};
use page::Page;
use recorder::Recorder;
use std::path::{Path, PathBuf};

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    if arguments.output == Path::new(STDOUT) {
        bail!(
            "--output: a session needs a file for its calibration. Name one, such as calibration.json"
        );
    }
    let destination = Destination::new(&arguments.output, arguments.force)?;
    arguments.robot.check_named()?;
    let session = arguments.session.clone();
    let session = session.unwrap_or_else(|| arguments.output.with_file_name("session.mcap"));
    output::refuse_existing(&session, arguments.force)?;
    if let Some(report) = arguments.report() {
        output::refuse_existing(&report, arguments.force)?;
    }
    let page = Page::open(arguments.web, &arguments.goal, &session)?;
    let ending = listen(arguments, session, &destination, &page);
    if let Err(error) = &ending {
        page.failed(causes(error));
    }
    ending
}

fn listen(
    arguments: &Arguments,
    session: PathBuf,
    destination: &Destination,
    page: &Page,
) -> Result<Ending> {
    let bus = arguments.domain.join(arguments.bag.topics())?;
    let recorder = Recorder::new(&session, arguments.force)?;
    let interrupt = Interrupt::new()?;
    output::say(&lines::beginning(&arguments.domain, &session, &arguments.goal));
    page.line().iter().for_each(|line| output::say(line));
    let calibrator = Calibrator::start(
        &session,
        (arguments.bag.options_of(&arguments.robot), arguments.robot.clone()),
        arguments.way(),
        page.scout()?,
    )?;
    let keyboard = Keyboard::listen()?;
    let mut listening = Listening::new(arguments, &bus, recorder, calibrator, page)?;
    let ended = listening.run(&keyboard, &interrupt)?;
    let taken = listening.finish()?;
    if taken < eyebolt_live::FEWEST {
        bail!(
            "{}: {taken} configurations are too few to calibrate: {} are the least. What came in is there",
            session.display(),
            eyebolt_live::FEWEST
        );
    }
    page.calibrates();
    let session = RecordingArguments { recording: session, bag: arguments.bag.clone() };
    let ending = calibrate::run(&calibrate::Arguments::of_session(
        (session, arguments.robot.clone()),
        (arguments.output.clone(), arguments.report()),
        arguments.way(),
        arguments.force,
    ))?;
    let trusted = matches!(ending, Ending::Done);
    page.done(trusted, destination.path(trusted), arguments.report().as_deref());
    if ended == Ended::Asked {
        output::say(&format!("ended before the goal of {} was met", arguments.goal));
    }
    if trusted && !arguments.no_tf && interrupt.check().is_ok() {
        publish::until_ended(&bus, &arguments.output, &keyboard, &interrupt)?;
    }
    Ok(ending)
}
