//! Poses in a recording that is still being made.

use super::arguments::Arguments;
use super::finder::Finder;
use super::lines::Line;
use super::standard_input::StandardInput;
use crate::ending::causes;
use crate::output;
use crate::progress::Interrupt;
use anyhow::{Result, bail};
use eyebolt_recording::{BagOptions, GrowingRecording, OPTICAL_FRAME, Recording, RecordingError};
use std::path::Path;
use std::thread::sleep;
use std::time::Duration;

/// From one look at the file to the next: as often as frames come.
const WAIT: Duration = Duration::from_millis(20);
/// Far more than a joint turns while a frame is taken: of a pose nobody asks whether the arm rests.
const ANY_MOTION: f64 = 1e3;

/// What is told of each frame that is in the MCAP that `arguments` name, or comes while it is written or by standard input, and told to `each` as soon
/// as it is known, until the file has its end, or Ctrl-C; and the name of the camera's optical frame.
pub(super) fn of(
    arguments: &Arguments,
    each: &mut dyn FnMut(&Line),
) -> Result<(Vec<Line>, String)> {
    let named = &arguments.recording.recording;
    let input = StandardInput::is_named(named).then(StandardInput::new).transpose()?;
    let path = &input.as_ref().map_or_else(|| named.clone(), StandardInput::path);
    let mut growing = growing(arguments, path)?;
    let interrupt = Interrupt::new()?;
    let (mut finder, mut waiting) = (None, Waiting::default());
    let mut lines: Vec<Line> = Vec::new();
    let (mut frame_id, mut looked_at) = (OPTICAL_FRAME.to_owned(), None);
    while interrupt.check().is_ok() {
        // Asked first: what came before the end is read then.
        let is_cut = input.as_ref().map_or(Ok(false), StandardInput::has_ended)?;
        let length = std::fs::metadata(path).map(|file| file.len()).ok();
        if looked_at == Some((length, is_cut)) {
            sleep(WAIT);
            continue;
        }
        looked_at = Some((length, is_cut));
        let has_ended = growing.has_ended()? || is_cut;
        let recording = match growing.now() {
            Ok(recording) => Recording::Bag(Box::new(recording)),
            // Something is not there yet.
            Err(error) if !has_ended && is_early(&error) => {
                waiting.tell(&error.into());
                continue;
            }
            Err(error) => return Err(error.into()),
        };
        if let Some(known) = recording.camera_frame_id() {
            frame_id = known.to_owned();
        }
        let finder = match &mut finder {
            Some(finder) => finder,
            None => {
                let arm = arguments.robot.arm(path, &recording)?;
                finder.insert(Finder::new(arguments, &arm, &recording)?)
            }
        };
        for index in 0..recording.frame_names().len() {
            if interrupt.check().is_err() {
                return Ok((lines, frame_id));
            }
            // Which frames there are is seen anew each time: stamps are what they are known by.
            if lines.last().is_none_or(|last| last.stamp_ns < recording.stamp_ns(index)) {
                let line = finder.line(&recording, index)?;
                each(&line);
                lines.push(line);
            }
        }
        if has_ended {
            break;
        }
    }
    Ok((lines, frame_id))
}

fn growing(arguments: &Arguments, path: &Path) -> Result<GrowingRecording> {
    let options = arguments.recording.bag.options_of(&arguments.robot);
    let options =
        BagOptions { max_motion: Some(options.max_motion.unwrap_or(ANY_MOTION)), ..options };
    if path.is_dir() || !GrowingRecording::is_one(path)? {
        bail!(
            "{}: --follow: only an MCAP is read while it is written. Record as MCAP, or leave --follow out",
            path.display()
        );
    }
    Ok(GrowingRecording::new(path, options))
}

/// Says what is waited for, once.
#[derive(Default)]
struct Waiting {
    said: String,
}

impl Waiting {
    fn tell(&mut self, error: &anyhow::Error) {
        // Numbers of messages grow.
        let text = causes(error);
        let said: String = text.chars().filter(|c| !c.is_ascii_digit()).collect();
        if said != self.said {
            output::complain(&format!("waiting: {text}"));
            self.said = said;
        }
    }
}

/// Whether an error may be one of a file in which something has not come yet.
fn is_early(error: &RecordingError) -> bool {
    !matches!(error, RecordingError::Read { .. })
}
