//! The joints of all frames of a recording, from the rows of one file.

use super::choice::shown;
use super::positions::invalid;
use crate::error::RecordingError;
use eyebolt_robot::JointPositions;
use std::collections::HashMap;
use std::path::Path;

/// Frames that wait for their rows.
#[derive(Debug)]
pub(super) struct Table<'a> {
    pub(super) path: &'a Path,
    frames: &'a [String],
    /// Where the row was, and what was in it.
    rows: Vec<Option<(String, JointPositions)>>,
    by_name: HashMap<&'a str, usize>,
    /// Under the digits after the zeros; `None` where several frames have the number.
    by_number: HashMap<&'a str, Option<usize>>,
}

impl<'a> Table<'a> {
    /// A table for `frames`, still empty; `path` is for messages.
    pub(super) fn new(path: &'a Path, frames: &'a [String]) -> Self {
        let by_name = frames.iter().enumerate().map(|(i, name)| (name.as_str(), i)).collect();
        let mut by_number = HashMap::new();
        for (i, name) in frames.iter().enumerate() {
            if let Some(number) = number(name) {
                by_number.entry(number).and_modify(|i| *i = None).or_insert(Some(i));
            }
        }
        Self { path, frames, rows: vec![None; frames.len()], by_name, by_number }
    }

    /// The frame that a row at `place` for frame `name` fills; `None` if the recording has no such
    /// frame, which may have been moved away.
    pub(super) fn frame(&self, name: &str, place: &str) -> Result<Option<usize>, RecordingError> {
        // Numbers are padded in file names and seldom in tables.
        let same_number = || number(name).and_then(|n| self.by_number.get(n).copied()).flatten();
        let index = self.by_name.get(name).copied().or_else(same_number);
        if let Some((earlier, _)) = index.and_then(|i| self.rows.get(i)?.as_ref()) {
            let earlier = earlier.trim_end_matches(": ");
            let problem = format!("{place}frame {} again, after {earlier}", shown(name));
            return Err(invalid(self.path, problem, "Keep one row for every frame"));
        }
        Ok(index)
    }

    /// Fills the frame that [`Table::frame`] told.
    pub(super) fn fill(&mut self, index: usize, place: String, positions: JointPositions) {
        if let Some(row) = self.rows.get_mut(index) {
            *row = Some((place, positions));
        }
    }

    /// The positions of all frames, in their order.
    pub(super) fn finish(self) -> Result<Vec<JointPositions>, RecordingError> {
        let rows = self.rows.into_iter().zip(self.frames);
        rows.map(|(row, frame)| {
            row.map(|(_, positions)| positions).ok_or_else(|| {
                let problem = format!("frame {frame} is not there");
                invalid(self.path, problem, "Add it, or move the files of the frame away")
            })
        })
        .collect()
    }
}

/// The digits after leading zeros, if there is nothing but digits.
fn number(name: &str) -> Option<&str> {
    let digits = !name.is_empty() && name.bytes().all(|byte| byte.is_ascii_digit());
    digits.then(|| name.trim_start_matches('0'))
}
