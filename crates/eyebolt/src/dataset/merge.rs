//! The indices of all shards joined into one.

use super::description::Description;
use super::error::DatasetError;
use super::index::{self, FrameKey, Index, IndexLine};
use super::recording::RecordingEntry;
use super::shard::Shard;
use std::path::{Path, PathBuf};

/// How many frames a data set has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Merged {
    /// Recordings.
    pub recordings: usize,
    /// Frames with labels.
    pub labelled: usize,
    /// Frames that were left out.
    pub left_out: usize,
}

/// Joins the indices of all shards in `folder`, and what was merged before, into one, and removes
/// them. Does nothing unless every frame of every recording is there.
///
/// # Errors
///
/// A shard that is missing, frames that are missing or told of differently, and files that cannot
/// be read or written.
pub fn merge(folder: &Path) -> Result<Merged, DatasetError> {
    Description::read(folder)?;
    let shards = shards(folder)?;
    complete(folder, &shards)?;
    let whole = folder.join(index::file_name(Shard::WHOLE));
    let mut all = if whole.exists() { index::read(&whole)? } else { Index::new() };
    for (_, path) in &shards {
        for (key, line) in index::read(path)? {
            let problem = format!(
                "frame {} of {} is told of differently elsewhere",
                key.number, key.recording
            );
            if all.insert(key, line.clone()).is_some_and(|other| other != line) {
                let remedy = "Shards were made by different versions: label them again";
                return Err(DatasetError::invalid(path, "frame", problem, remedy));
            }
        }
    }
    let recordings = recordings(folder)?;
    recordings.iter().try_for_each(|recording| check(folder, recording, &all))?;
    index::write(&whole, &all)?;
    for (_, path) in &shards {
        std::fs::remove_file(path).map_err(|error| DatasetError::write(path, &error))?;
    }
    let labelled = all.values().filter(|line| line.labelled.is_some()).count();
    Ok(Merged { recordings: recordings.len(), labelled, left_out: all.len() - labelled })
}

/// The shards whose indices lie in `folder`, in order.
pub(super) fn shards(folder: &Path) -> Result<Vec<(Shard, PathBuf)>, DatasetError> {
    let mut shards: Vec<(Shard, PathBuf)> = list(folder)?
        .into_iter()
        .filter_map(|path| Some((index::shard_of(path.file_name()?.to_str()?)?, path)))
        .collect();
    shards.sort_by_key(|(shard, _)| (shard.count(), shard.index()));
    Ok(shards)
}

/// Refuses shards of which one is missing.
fn complete(folder: &Path, shards: &[(Shard, PathBuf)]) -> Result<(), DatasetError> {
    let Some((first, _)) = shards.first() else {
        let problem = "there are no indices of shards to merge";
        let remedy = "Label with shards first; one run without shards needs no merging";
        return Err(DatasetError::invalid(folder, "shards", problem, remedy));
    };
    let count = first.count();
    if let Some((other, path)) = shards.iter().find(|(shard, _)| shard.count() != count) {
        let problem = format!("one of {}, but there is one of {count} too", other.count());
        let remedy = "Run all shards with one number of shards, and remove the indices of others";
        return Err(DatasetError::invalid(path, "shards", problem, remedy));
    }
    let missing = (0..count).find(|index| shards.iter().all(|(shard, _)| shard.index() != *index));
    match missing {
        None => Ok(()),
        Some(index) => {
            let problem = format!("the index of shard {index}/{count} is missing");
            let remedy = format!("Run shard {index}/{count} to its end, then merge again");
            Err(DatasetError::invalid(folder, "shards", problem, remedy))
        }
    }
}

/// Refuses a recording of which a frame is missing.
fn check(folder: &Path, recording: &RecordingEntry, all: &Index) -> Result<(), DatasetError> {
    let key = |number| FrameKey { recording: recording.id.clone(), number };
    let is_there = |line: &IndexLine| {
        let file = line.labelled.as_ref().map(|labelled| folder.join(&labelled.file));
        file.is_none_or(|file| file.is_file())
    };
    let missing =
        (0..recording.frames).find(|number| !all.get(&key(*number)).is_some_and(is_there));
    match missing {
        None => Ok(()),
        Some(number) => {
            let problem = format!("frame {number} of recording {} is missing", recording.source);
            let remedy = "Run every shard with the same recordings to its end, then merge again";
            Err(DatasetError::invalid(folder, "frames", problem, remedy))
        }
    }
}

/// All recordings of the data set in `folder`.
fn recordings(folder: &Path) -> Result<Vec<RecordingEntry>, DatasetError> {
    let mut files = list(&folder.join("recordings"))?;
    files.retain(|path| path.extension().is_some_and(|ending| ending == "toml"));
    files.sort();
    files.iter().map(|path| RecordingEntry::read(path)).collect()
}

fn list(folder: &Path) -> Result<Vec<PathBuf>, DatasetError> {
    let failed = |cause| DatasetError::Read {
        file: folder.display().to_string(),
        cause,
        remedy: "Name the folder of a data set that `label` wrote".to_owned(),
    };
    let entries = std::fs::read_dir(folder).map_err(failed)?;
    entries.map(|entry| entry.map(|entry| entry.path()).map_err(failed)).collect()
}
