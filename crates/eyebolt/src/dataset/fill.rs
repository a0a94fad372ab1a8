//! All frames of a recording, or a shard of them, into a store.

use super::error::DatasetError;
use super::frame::DatasetFrame;
use super::index::{FrameKey, IndexLine};
use super::recording::RecordingEntry;
use super::run::{LabelRun, Labelled};
use super::store::Store;
use crate::progress::{Cancelled, Progress};
use crate::record::RecordError;
use eyebolt_recording::FrameSource;
use eyebolt_robot::JointPositions;
use rayon::prelude::*;
use std::error::Error;

/// Why the frames of a recording could not be put into a data set.
#[derive(Debug, thiserror::Error)]
pub enum FillError {
    /// A frame cannot be read.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The data set cannot be read or written.
    #[error(transparent)]
    Dataset(#[from] DatasetError),
    /// Whoever looks at the frames could not.
    #[error("{0}")]
    Look(Box<dyn Error + Send + Sync>),
    /// Whoever hears of the progress ended it.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Sees each frame that is labelled, and the name of its file.
pub type Look<'a> =
    dyn Fn(&str, &DatasetFrame) -> Result<(), Box<dyn Error + Send + Sync>> + Sync + 'a;

/// What became of the frames of a recording that are in this shard.
#[derive(Clone, Debug, Default)]
pub struct Filled {
    /// Their lines in the index, in order.
    pub lines: Vec<IndexLine>,
    /// How many of them were there before.
    pub known: usize,
}

/// Frames that are worked on at a time: enough for every thread, few enough for memory.
const BATCH: usize = 16;

/// Labels every frame of `recording` in this machine's shard that `store` does not have yet, shows
/// each to `look`, and writes the index.
///
/// # Errors
///
/// What cannot be read or written, or a cancellation; frames that were written before stay, and are
/// found by the next run.
pub fn fill(
    store: &mut Store,
    recording: &RecordingEntry,
    source: &dyn FrameSource,
    run: &LabelRun<'_>,
    look: &Look<'_>,
    progress: &dyn Progress,
) -> Result<Filled, FillError> {
    let taken = |number: &usize| store.shard().takes(&recording.id, *number);
    let numbers: Vec<usize> = (0..source.frame_names().len()).filter(taken).collect();
    let mut filled = Filled::default();
    let one = |number: &usize| -> Result<(IndexLine, bool), FillError> {
        let name = &source.frame_names()[*number];
        if let Some(known) = store.find(recording, *number, name)? {
            return Ok((known, true));
        }
        let key = FrameKey { recording: recording.id.clone(), number: *number };
        let labelled = match run.frame(*number)? {
            Ok(Labelled { frame, joints }) => {
                let joints = told(&joints, &store.description().robot.joints);
                DatasetFrame::new(frame, run.camera(), joints)
            }
            Err(left_out) => {
                let (frame, left_out) = (name.clone(), Some(left_out.to_string()));
                return Ok((IndexLine { key, frame, labelled: None, left_out }, false));
            }
        };
        look(&recording.frame_file(*number, name), &labelled).map_err(FillError::Look)?;
        Ok((store.put(recording, *number, name, &labelled)?, false))
    };
    for batch in numbers.chunks(BATCH) {
        progress.advance(filled.lines.len(), numbers.len())?;
        // Collected first: of several errors the first is reported, whichever thread met it.
        let done: Vec<_> = batch.par_iter().map(one).collect();
        for done in done {
            let (line, known) = done?;
            filled.lines.push(line);
            filled.known += usize::from(known);
        }
    }
    store.finish(filled.lines.clone())?;
    Ok(filled)
}

/// Positions of the joints called `names`, of those that were recorded.
fn told(recorded: &JointPositions, names: &[String]) -> JointPositions {
    names.iter().filter_map(|name| Some((name.clone(), recorded.get(name)?))).collect()
}
