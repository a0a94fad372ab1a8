//! What is done with a calibration: written, exported, evaluated, watched.

use super::caller::Caller;
use super::error::CallError;
use super::options::{other, parsed};
use crate::arguments::Command;
use crate::monitor as monitor_command;
use crate::output::{Destination, write_whole};
use crate::{evaluate as evaluate_command, export as export_command};
use eyebolt::export::SavedCalibration;
use eyebolt::progress::Progress;
use eyebolt_recording::Recording;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Refuses `text` that is no calibration; `name` is for messages.
///
/// # Errors
///
/// Text that is none, or is of another version.
pub fn check(name: &str, text: &str) -> Result<(), CallError> {
    parse(name, text).map(drop)
}

fn parse(name: &str, text: &str) -> Result<SavedCalibration, CallError> {
    Ok(SavedCalibration::parse(name, text).map_err(anyhow::Error::new)?)
}

/// Writes the calibration `text` to `path`, or to `*.rejected.json` beside it if it was refused, as `eyebolt calibrate`
/// does; where it is.
///
/// # Errors
///
/// A file that exists, unless `force` is given; a place where nothing can be written.
pub fn save(path: &Path, text: &str, trusted: bool, force: bool) -> Result<PathBuf, CallError> {
    Ok(Destination::new(path, force)?.write(trusted, text.as_bytes())?)
}

/// Writes `bytes` to `path`, whole or not at all.
///
/// # Errors
///
/// A file that exists, unless `force` is given; a place where nothing can be written.
pub fn write(path: &Path, bytes: &[u8], force: bool) -> Result<(), CallError> {
    Ok(write_whole(path, bytes, force)?)
}

/// The calibration `text` in the form that `words` ask for, as `eyebolt export` writes it; formats with a name of their
/// own are called `name`.
///
/// # Errors
///
/// Words that are none of its options; a calibration that was refused, or cannot be read; frames that cannot be placed.
pub fn export(
    mut words: Vec<OsString>,
    text: &str,
    name: &str,
    caller: &Caller<'_>,
) -> Result<Vec<u8>, CallError> {
    // Formats that are not text want a file; nothing is written here.
    words.splice(0..0, ["--output=-".into(), MEMORY.into()]);
    let Command::Export(arguments) = parsed("export", words)? else { return other() };
    Ok(export_command::bytes(&arguments, &parse(MEMORY, text)?, name, caller)?)
}

/// What a calibration that is in no file is called.
const MEMORY: &str = "calibration";

/// How far off the calibration (its name and text) is, or the tables of the models that `words` name, as `eyebolt evaluate`
/// says it as JSON.
///
/// # Errors
///
/// Words that are none of its options; recordings without truth; a calibration or a model that cannot be read, or does
/// not fit; work that was ended.
pub fn evaluate(
    words: Vec<OsString>,
    calibration: Option<(&str, &str)>,
    caller: &Caller<'_>,
) -> Result<String, CallError> {
    let Command::Evaluate(arguments) = parsed("evaluate", words)? else { return other() };
    Ok(evaluate_command::json(&arguments, calibration, caller)?)
}

/// Holds `frames`, or the recording that `words` name, against the calibration (its name and text) as `eyebolt monitor`
/// does, and hands what it says of each view as JSON to `each`; whether there is an alarm.
///
/// # Errors
///
/// Words that are none of its options; a calibration, a recording or a robot that cannot be read, or do not fit; work that
/// `progress` ended.
pub fn monitor(
    mut words: Vec<OsString>,
    calibration: (&str, &str),
    frames: Option<Recording<'_>>,
    (caller, progress): (&Caller<'_>, &dyn Progress),
    each: &mut dyn FnMut(String),
) -> Result<bool, CallError> {
    let (name, text) = calibration;
    words.insert(0, name.into());
    let Command::Monitor(arguments) = parsed("monitor", words)? else { return other() };
    let saved = parse(name, text)?;
    let recording = || match frames {
        Some(frames) => Ok(frames),
        None => monitor_command::named(&arguments),
    };
    let mut views = 0;
    let mut hand_on = |report: eyebolt::monitor::ViewReport| -> anyhow::Result<()> {
        views += 1;
        progress.advance(views, views)?;
        each(serde_json::to_string(&report)?);
        Ok(())
    };
    Ok(monitor_command::of(&arguments, &saved, recording, caller, &mut hand_on)?)
}
