//! The eyebolt program: the calibration between a depth camera and a robot arm, without markers.
//!
//! [`program`] is all of it; [`call`] has the commands as functions, with the same options, for front ends that are no
//! terminal.

mod arguments;
mod batch;
mod calibrate;
pub mod call;
mod completions;
mod convert;
mod demo;
mod ending;
mod evaluate;
mod export;
mod front;
mod info;
mod init;
mod inputs;
mod label;
#[cfg(feature = "live")]
mod live;
mod logging;
mod man;
mod monitor;
mod names;
mod output;
mod plan;
mod pose;
mod progress;
mod record_command;
mod reproduce;
mod robots;
mod segment;
mod shell;
mod simulate;
mod study;
mod summary;
mod train;

use arguments::{Arguments, Command};
use clap::{ArgMatches, CommandFactory, FromArgMatches};
use ending::{Ending, causes};
use std::ffi::OsString;
use std::io::Write;

/// Runs the program on `words`, the first of which is its own name; the exit status.
///
/// `started_by` are the words that start it anew, as a command that runs others does. Whoever calls it leaves Ctrl-C,
/// standard output and standard error to it, and ends after it.
#[must_use]
pub fn program(started_by: &[OsString], words: impl IntoIterator<Item = OsString>) -> u8 {
    let status = match Arguments::command().try_get_matches_from(words) {
        Ok(matches) => match Arguments::from_arg_matches(&matches) {
            Ok(arguments) => run(arguments, &matches, started_by),
            Err(error) => usage(&error),
        },
        Err(error) => usage(&error),
    };
    // Where the standard library does not end the process itself, nobody else does this.
    let _ = std::io::stdout().flush();
    status
}

/// What is said where nothing is run: help, or what is wrong with the flags.
fn usage(error: &clap::Error) -> u8 {
    let _ = error.print();
    u8::try_from(error.exit_code()).unwrap_or(2)
}

fn run(arguments: Arguments, matches: &ArgMatches, started_by: &[OsString]) -> u8 {
    let Arguments { command, verbose } = arguments;
    logging::start(verbose);
    let ending = match command {
        Command::Demo(arguments) => demo::run(&arguments),
        Command::Calibrate(arguments) => calibrate::run(&arguments),
        Command::Batch(arguments) => batch::run(&arguments, matches),
        Command::Info(arguments) => info::run(&arguments),
        Command::Init(arguments) => init::run(&arguments),
        Command::ToRecord(arguments) => record_command::run(&arguments),
        Command::Convert(arguments) => convert::run(&arguments),
        Command::Simulate(arguments) => simulate::run(&arguments),
        Command::Evaluate(arguments) => evaluate::run(&arguments),
        Command::Reproduce(arguments) => reproduce::run(&arguments, started_by),
        Command::Study(arguments) => study::run(&arguments),
        Command::Train(arguments) => train::run(&arguments),
        Command::Segment(arguments) => segment::run(&arguments),
        Command::Pose(arguments) => pose::run(&arguments),
        Command::Label(arguments) => label::run(&arguments),
        Command::Monitor(arguments) => monitor::run(&arguments),
        #[cfg(feature = "live")]
        Command::Live(arguments) => live::run(&arguments),
        Command::Plan(arguments) => plan::run(&arguments),
        Command::Export(arguments) => export::run(&arguments),
        Command::Completions(arguments) => completions::run(&arguments, Arguments::command()),
        Command::Man(arguments) => man::run(&arguments, Arguments::command()),
    };
    match ending {
        Ok(Ending::Done) => 0,
        Ok(Ending::Refused) => 3,
        Err(error) => {
            output::complain(&format!("error: {}", causes(&error)));
            1
        }
    }
}
