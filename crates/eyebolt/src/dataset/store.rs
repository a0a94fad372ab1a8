//! A data set that frames are put into, by one machine or by many.

use super::description::Description;
use super::error::DatasetError;
use super::files::{MOST_FRAME_BYTES, read, read_text, write_once, write_whole};
use super::frame::DatasetFrame;
use super::index::{self, FileLine, FrameKey, Index, IndexLine};
use super::recording::{Calibrated, RecordingEntry};
use super::shard::Shard;
use std::path::{Path, PathBuf};

/// A data set that frames are put into.
#[derive(Debug)]
pub struct Store {
    folder: PathBuf,
    description: Description,
    shard: Shard,
    index: Index,
}

impl Store {
    /// The data set in `folder`, which is made once there is something to put into it; of another
    /// machine's shards nothing is read or written.
    ///
    /// # Errors
    ///
    /// A data set of another robot, or one that is damaged.
    pub fn open(
        folder: &Path,
        description: Description,
        shard: Shard,
    ) -> Result<Self, DatasetError> {
        description.check_there(folder)?;
        let path = folder.join(index::file_name(shard));
        let index = if path.exists() { index::read(&path)? } else { Index::new() };
        Ok(Self { folder: folder.to_owned(), description, shard, index })
    }

    /// Which frames this machine labels.
    pub fn shard(&self) -> Shard {
        self.shard
    }

    /// What is known of a recording by its ID from other runs: itself, and the calibration that its
    /// frames are labelled by, as JSON.
    ///
    /// # Errors
    ///
    /// A file that cannot be read.
    pub fn known(&self, id: &str) -> Result<Option<(RecordingEntry, String)>, DatasetError> {
        let path = self.folder.join(format!("recordings/{id}.toml"));
        if !path.exists() {
            return Ok(None);
        }
        let entry = RecordingEntry::read(&path)?;
        let calibration = self.folder.join(&entry.calibration);
        let remedy = "Remove what the data set has of this recording, and label it again";
        Ok(Some((entry, read_text(&calibration, remedy)?)))
    }

    /// Tells of a recording before its frames come: what it is and its calibration, as JSON. The
    /// calibration that its frames are to be labelled by: if several machines found one each from
    /// nothing, that of the first.
    ///
    /// # Errors
    ///
    /// The data set has it by another calibration that was given, or with other options, or files
    /// that cannot be written.
    pub fn begin(
        &self,
        recording: &RecordingEntry,
        calibration: &str,
    ) -> Result<String, DatasetError> {
        self.description.write(&self.folder)?;
        let differs = |path: &Path, field: &str, problem: &str| {
            let remedy = "Write to another folder, or remove this recording's files first";
            DatasetError::invalid(path, field, problem, remedy)
        };
        let path = self.folder.join(&recording.calibration);
        let there = write_once(&path, calibration.as_bytes())?;
        let is_found = recording.calibrated == Calibrated::FromNothing;
        if there != calibration.as_bytes() && !is_found {
            return Err(differs(
                &path,
                "calibration",
                "frames are labelled by another one already",
            ));
        }
        let path = self.folder.join(format!("recordings/{}.toml", recording.id));
        let text = toml::to_string(recording).expect("an entry is plain data");
        if write_once(&path, text.as_bytes())? != text.as_bytes() {
            return Err(differs(&path, "masks", "frames are labelled with other options already"));
        }
        String::from_utf8(there)
            .map_err(|_| differs(&path, "calibration", "the calibration is no text"))
    }

    /// What is known of a frame: its line in the index, or, after a run that was ended, its file.
    ///
    /// # Errors
    ///
    /// A file that is damaged.
    pub fn find(
        &self,
        recording: &RecordingEntry,
        number: usize,
        name: &str,
    ) -> Result<Option<IndexLine>, DatasetError> {
        let key = FrameKey { recording: recording.id.clone(), number };
        let file = recording.frame_file(number, name);
        let path = self.folder.join(&file);
        if let Some(line) = self.index.get(&key) {
            // A file that somebody removed or cut is made anew.
            let is_whole = |file: &FileLine| {
                std::fs::metadata(&path).is_ok_and(|there| there.len() == file.bytes)
            };
            let is_there = line.labelled.as_ref().is_none_or(is_whole);
            return Ok(is_there.then(|| line.clone()));
        }
        if !path.exists() {
            return Ok(None);
        }
        let bytes = read(&path, MOST_FRAME_BYTES, "Remove the file and label again")?;
        let frame = DatasetFrame::decode(&path, &bytes, &self.description)?;
        let labelled = Some(FileLine::new(file, &bytes, &frame));
        Ok(Some(IndexLine { key, frame: name.to_owned(), labelled, left_out: None }))
    }

    /// Writes the file of a frame; its line for the index.
    ///
    /// # Errors
    ///
    /// A file that cannot be written.
    pub fn put(
        &self,
        recording: &RecordingEntry,
        number: usize,
        name: &str,
        frame: &DatasetFrame,
    ) -> Result<IndexLine, DatasetError> {
        let file = recording.frame_file(number, name);
        let bytes = frame.encode(&self.description);
        write_whole(&self.folder.join(&file), &bytes)?;
        let key = FrameKey { recording: recording.id.clone(), number };
        let labelled = Some(FileLine::new(file, &bytes, frame));
        Ok(IndexLine { key, frame: name.to_owned(), labelled, left_out: None })
    }

    /// Writes the index with these lines in it.
    ///
    /// # Errors
    ///
    /// A file that cannot be written.
    pub fn finish(&mut self, lines: Vec<IndexLine>) -> Result<(), DatasetError> {
        self.index.extend(lines.into_iter().map(|line| (line.key.clone(), line)));
        index::write(&self.folder.join(index::file_name(self.shard)), &self.index)
    }

    /// What the numbers of its files mean.
    pub fn description(&self) -> &Description {
        &self.description
    }
}
