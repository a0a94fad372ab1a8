//! `pose` and `segment` as functions.

use super::error::CallError;
use super::options::{other, parsed};
use crate::arguments::Command;
use crate::{pose as pose_command, segment as segment_command};
use eyebolt::progress::Progress;
use eyebolt_recording::Recording;
use std::ffi::OsString;

/// The labels of a frame.
pub struct LabelledFrame {
    /// The frame's name.
    pub name: String,
    /// Pixels in a row, and number of rows.
    pub size: [usize; 2],
    /// Of each pixel, row by row: 0 background, 1 arm, 2 end-effector, 255 no depth.
    pub label: Vec<u8>,
}

/// Labels each frame of `frames`, or of the recording that `words` name, as `eyebolt segment` does, and hands it to
/// `each`; the names of damaged frames, which are left out.
///
/// # Errors
///
/// Words that are none of its options; a model or a recording that cannot be read; what `each` says; work that `progress`
/// ended.
pub fn segment(
    mut words: Vec<OsString>,
    frames: Option<Recording<'_>>,
    progress: &dyn Progress,
    each: &mut dyn FnMut(LabelledFrame) -> Result<(), CallError>,
) -> Result<Vec<String>, CallError> {
    // The command writes files; nothing is written here.
    words.insert(0, "--output=.".into());
    let Command::Segment(arguments) = parsed("segment", words)? else { return other() };
    let recording = match frames {
        Some(frames) => frames,
        None => segment_command::named(&arguments)?,
    };
    let teller = segment_command::teller(&arguments, &recording)?;
    let mut hand_on = |frame: segment_command::Segmented<'_>| -> anyhow::Result<()> {
        let size = [frame.found.width, frame.found.height];
        let label = frame.found.label;
        Ok(each(LabelledFrame { name: frame.name.to_owned(), size, label })?)
    };
    Ok(segment_command::of(&arguments, teller, &recording, progress, &mut hand_on)?)
}

/// Where the end-effector is in each frame of `frames`, or of the recording that `words` name, as `eyebolt pose` says it
/// as JSON.
///
/// # Errors
///
/// Words that are none of its options; a model, a robot or a recording that cannot be read, or do not fit; work that
/// `progress` ended. Frames without an answer are none.
pub fn pose(
    words: Vec<OsString>,
    frames: Option<Recording<'_>>,
    progress: &dyn Progress,
) -> Result<Vec<String>, CallError> {
    let Command::Pose(arguments) = parsed("pose", words)? else { return other() };
    let recording = match frames {
        Some(frames) => frames,
        None => pose_command::named(&arguments)?,
    };
    let lines = pose_command::of(&arguments, &recording, progress, &mut |_| ())?;
    Ok(lines.iter().map(|line| line.json()).collect())
}
