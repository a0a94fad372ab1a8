//! `label` and `train` as functions.

use super::caller::Caller;
use super::error::CallError;
use super::options::{other, parsed};
use crate::arguments::Command;
use crate::label::{self as label_command, Told};
use crate::train as train_command;
use std::ffi::OsString;

/// Labels the frames of the recordings that `words` name into a data set, as `eyebolt label` does, by the calibration (its
/// name and text) if one is given; what became of each recording, as JSON.
///
/// # Errors
///
/// Words that are none of its options; recordings, a robot or a calibration that cannot be read, or do not fit; a folder
/// that is no data set; work that was ended. A recording whose calibration is refused is none.
pub fn label(
    words: Vec<OsString>,
    calibration: Option<(String, String)>,
    caller: &Caller<'_>,
) -> Result<Vec<String>, CallError> {
    let Command::Label(arguments) = parsed("label", words)? else { return other() };
    let mut lines = Vec::new();
    label_command::each(&arguments, calibration, caller, &mut |recording, told| {
        lines.push(match told {
            Told::Labelled(labelled) => labelled.json(),
            Told::Refused(reasons) => {
                let recording = recording.display().to_string();
                serde_json::json!({ "recording": recording, "refused": reasons }).to_string()
            }
        });
    })?;
    Ok(lines)
}

/// Teaches the networks that `words` ask for, or goes on with them, as `eyebolt train` does; names of their folders in that
/// of the model.
///
/// # Errors
///
/// Words that are none of its options; a robot, a data set or a model that cannot be read; files that cannot be written;
/// work that was ended, which goes on with the same words.
pub fn train(words: Vec<OsString>, caller: &Caller<'_>) -> Result<Vec<&'static str>, CallError> {
    let Command::Train(arguments) = parsed("train", words)? else { return other() };
    Ok(train_command::taught(&arguments, caller)?)
}
