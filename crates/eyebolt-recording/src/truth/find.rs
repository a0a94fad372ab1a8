//! Where the truth of a recording lies.

use super::parse::Source;
use super::written::{KEY, RECORD, Truth};
use crate::bag::{Bag, is_bag};
use crate::error::RecordingError;
use crate::file::read_text;
use crate::folder::MANIFEST;
use crate::pattern::extension;
use crate::recording::Recording;
use std::path::Path;

/// Name of the file in folders.
pub(crate) const FILE: &str = "truth.json";
/// What stands before a field in messages about MCAP.
const IN_RECORD: &str = "metadata eyebolt.truth: ";

/// Reads the truth of the simulated recording at `path`: an MCAP, a folder with one in it or with
/// a `recording.toml` and a `truth.json`, or a file of JSON with nothing but the truth.
///
/// # Errors
///
/// A recording without truth, as all are that were not simulated; a file that cannot be read; JSON
/// that is not of the schema `eyebolt.truth/1`: fields missing, numbers that are not finite,
/// matrices that are not 4x4 or no rigid transforms.
pub fn read_truth(path: &Path) -> Result<Truth, RecordingError> {
    let in_folder = |folder: &Path| Some(folder.join(FILE)).filter(|file| file.exists());
    let file = if path.is_dir() && path.join(MANIFEST).exists() {
        in_folder(path)
    } else if is_bag(path) {
        return in_bag(path);
    } else {
        match extension(path).as_str() {
            "toml" => in_folder(path.parent().unwrap_or(Path::new(""))),
            // What is not there is an error of reading it.
            "json" => Some(path.to_path_buf()),
            _ => Some(path.to_path_buf()).filter(|path| !path.exists()),
        }
    };
    let file = file.ok_or_else(|| none(path))?;
    Source { path: &file, place: "" }.parse(&read_text(&file, "the truth")?)
}

#[cfg(fuzzing)]
impl Truth {
    /// The truth that the text of the file at `path` spells.
    pub(crate) fn parse(path: &Path, text: &str) -> Result<Self, RecordingError> {
        Source { path, place: "" }.parse(text)
    }
}

fn in_bag(path: &Path) -> Result<Truth, RecordingError> {
    let bag = Bag::open(path, Path::new("."))?;
    let text = of_bag(&bag, path)?.ok_or_else(|| none(path))?;
    Source { path, place: IN_RECORD }.parse(&text)
}

/// The text of the truth, if there is one, for whoever copies the recording: not parsed.
pub(crate) fn text_of(recording: &Recording) -> Result<Option<String>, RecordingError> {
    match recording {
        Recording::Folder(folder) => in_folder(folder.path().parent().unwrap_or(Path::new(""))),
        Recording::Bag(recording) => {
            let copied = recording.copy_source();
            of_bag(copied.messages(), copied.path())
        }
        Recording::Other(_) => Ok(None),
    }
}

fn in_folder(folder: &Path) -> Result<Option<String>, RecordingError> {
    let path = folder.join(FILE);
    if path.exists() { read_text(&path, "the truth").map(Some) } else { Ok(None) }
}

fn of_bag(bag: &Bag, path: &Path) -> Result<Option<String>, RecordingError> {
    let Some(mut record) = bag.record(RECORD)? else { return Ok(None) };
    let missing = || Source { path, place: IN_RECORD }.invalid(KEY, "the key is missing");
    record.remove(KEY).ok_or_else(missing).map(Some)
}

fn none(path: &Path) -> RecordingError {
    let problem = "no truth in it: only simulated recordings know it";
    let remedy = "Give a recording that `eyebolt simulate` wrote, or its truth.json";
    RecordingError::invalid(path, "truth", problem, remedy)
}
