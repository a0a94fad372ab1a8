//! `eyebolt pose`.

mod arguments;
mod finder;
mod follow;
mod lines;
mod mcap;
mod standard_input;

use crate::ending::Ending;
use crate::inputs::use_threads;
use crate::output;
use crate::progress::Counting;
use anyhow::{Result, bail};
pub use arguments::Arguments;
use eyebolt::progress::Progress;
use eyebolt_recording::{OPTICAL_FRAME, Recording, counted};
use finder::Finder;
use lines::Line;
use standard_input::StandardInput;
use std::fs::File;
use std::path::Path;

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    if let Some(path) = &arguments.output {
        output::refuse_existing(path, arguments.force)?;
    }
    let follow = arguments.follow || StandardInput::is_named(&arguments.recording.recording);
    let at_once = arguments.json || follow;
    let mut tell = |line: &Line| {
        if at_once {
            output::say(&if arguments.json { line.json() } else { line.text() });
        }
    };
    let (lines, frame_id) = if follow {
        follow::of(arguments, &mut tell)?
    } else {
        let recording = named(arguments)?;
        let lines = of(arguments, &recording, &Counting::new()?, &mut tell)?;
        (lines, recording.camera_frame_id().unwrap_or(OPTICAL_FRAME).to_owned())
    };
    if !at_once {
        lines.iter().for_each(|line| output::say(&line.text()));
    }
    if let Some(path) = &arguments.output {
        write(path, &lines, &frame_id, arguments.force)?;
    }
    let answered = lines.iter().filter(|line| line.answered).count();
    if !arguments.json {
        output::say(&format!("{answered} of {} answered", counted(lines.len(), "frame")));
    }
    Ok(if answered == 0 { Ending::Refused } else { Ending::Done })
}

fn write(path: &Path, lines: &[Line], frame_id: &str, force: bool) -> Result<()> {
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("mcap")) {
        let filled = |file: &mut File| {
            mcap::write(lines, frame_id, file).map_err(|error| output::named(error, path))
        };
        return output::write_through(path, force, filled);
    }
    let text: String = lines.iter().map(|line| line.json() + "\n").collect();
    output::write_whole(path, text.as_bytes(), force)
}

/// The recording that `arguments` name.
pub(crate) fn named(arguments: &Arguments) -> Result<Recording<'static>> {
    arguments.recording.open_or_cloud(&arguments.robot)
}

/// What is told of each frame of `recording`, and told to `each` as soon as it is known.
pub(crate) fn of(
    arguments: &Arguments,
    recording: &Recording<'_>,
    progress: &dyn Progress,
    each: &mut dyn FnMut(&Line),
) -> Result<Vec<Line>> {
    let path = &arguments.recording.recording;
    let names = recording.frame_names();
    if names.is_empty() {
        bail!("{}: there is no frame in it", path.display());
    }
    let arm = arguments.robot.arm(path, recording)?;
    let mut finder = Finder::new(arguments, &arm, recording)?;
    let mut lines = Vec::with_capacity(names.len());
    for index in 0..names.len() {
        progress.advance(index, names.len())?;
        let line = finder.line(recording, index)?;
        each(&line);
        lines.push(line);
    }
    progress.advance(names.len(), names.len())?;
    Ok(lines)
}
