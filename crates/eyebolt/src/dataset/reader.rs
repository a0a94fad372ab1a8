//! A data set to learn from.

use super::description::Description;
use super::error::DatasetError;
use super::files::{MOST_FRAME_BYTES, check_place, read, read_text};
use super::frame::DatasetFrame;
use super::index::{self, FileLine, IndexLine};
use super::recording::RecordingEntry;
use super::shard::Shard;
use eyebolt_robot::Arm;
use std::path::{Path, PathBuf};

/// A data set, opened; frames are read one by one, from as many threads as wanted.
#[derive(Clone, Debug)]
pub struct Dataset {
    folder: PathBuf,
    description: Description,
    frames: Vec<FrameEntry>,
    left_out: Vec<IndexLine>,
}

/// A labelled frame of a data set, before it is read.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameEntry {
    /// ID of its recording.
    pub recording: String,
    /// Its number in the recording, from 0.
    pub number: usize,
    /// Its name in the recording.
    pub name: String,
    /// Its file, and what is in it.
    pub file: FileLine,
}

/// What to do about a file that is not the one that was written.
const REMEDY: &str = "Remove the file and label the recording again: frames that are whole stay";

impl Dataset {
    /// Opens the data set in `folder`.
    ///
    /// # Errors
    ///
    /// A folder that is none, a data set of another version, one whose shards are not merged yet,
    /// and an index that is damaged.
    pub fn open(folder: &Path) -> Result<Self, DatasetError> {
        let description = Description::read(folder)?;
        let path = folder.join(index::file_name(Shard::WHOLE));
        if !path.exists() {
            let problem = match super::merge::shards(folder)?.is_empty() {
                true => "there is no index: no run has come to its end",
                false => "there is no index of all frames, only of shards",
            };
            let remedy = "Label again, which goes on where it ended, or merge the shards";
            return Err(DatasetError::invalid(&path, "index", problem, remedy));
        }
        let (mut frames, mut left_out) = (Vec::new(), Vec::new());
        for line in index::read(&path)?.into_values() {
            let IndexLine { key, frame, labelled, .. } = line.clone();
            match labelled {
                None => left_out.push(line),
                Some(file) => {
                    check_place(&path, &file.file)?;
                    let (recording, number) = (key.recording, key.number);
                    frames.push(FrameEntry { recording, number, name: frame, file });
                }
            }
        }
        Ok(Self { folder: folder.to_owned(), description, frames, left_out })
    }

    /// What the numbers mean: robot, classes, keypoints, symmetry.
    pub fn description(&self) -> &Description {
        &self.description
    }

    /// All labelled frames, by recording and number.
    pub fn frames(&self) -> &[FrameEntry] {
        &self.frames
    }

    /// Frames that were left out, with reasons.
    pub fn left_out(&self) -> &[IndexLine] {
        &self.left_out
    }

    /// Refuses a data set that is not of `arm`.
    ///
    /// # Errors
    ///
    /// Another robot description, base or end-effector.
    pub fn check_robot(&self, arm: &Arm) -> Result<(), DatasetError> {
        let robot = &self.description.robot;
        let same = [
            ("robot.urdf_hash", robot.urdf_hash.as_str(), arm.robot().urdf_hash()),
            ("robot.base", &robot.base, arm.base_name()),
            ("robot.end_effector", &robot.end_effector, arm.end_effector_name()),
        ];
        let Some((field, there, _)) = same.iter().find(|(_, there, own)| there != own) else {
            return Ok(());
        };
        let path = self.folder.join(super::description::FILE);
        let problem = format!("{there:?} is not that of robot {:?}", arm.robot().name);
        let remedy = "Give the robot description, base and end-effector that it was labelled with";
        Err(DatasetError::invalid(&path, *field, problem, remedy))
    }

    /// Where frames of recording `id` came from.
    ///
    /// # Errors
    ///
    /// A file that is missing or damaged.
    pub fn recording(&self, id: &str) -> Result<RecordingEntry, DatasetError> {
        RecordingEntry::read(&self.folder.join(format!("recordings/{id}.toml")))
    }

    /// The calibration of recording `entry`, as JSON.
    ///
    /// # Errors
    ///
    /// A file that is missing.
    pub fn calibration(&self, entry: &RecordingEntry) -> Result<String, DatasetError> {
        read_text(&self.folder.join(&entry.calibration), "Label the recording again")
    }

    /// Reads a frame, all of it.
    ///
    /// # Errors
    ///
    /// A file that is missing, cut, changed, or says what no frame says: depth that is no number,
    /// classes that there are not, a pose that is no rigid motion.
    pub fn read(&self, entry: &FrameEntry) -> Result<DatasetFrame, DatasetError> {
        let FileLine { file, bytes: length, blake3, .. } = &entry.file;
        let path = self.folder.join(file);
        let bytes = read(&path, MOST_FRAME_BYTES, REMEDY)?;
        if bytes.len() as u64 != *length {
            let problem = format!("{} bytes, but {length} were written", bytes.len());
            return Err(DatasetError::invalid(&path, "length", problem, REMEDY));
        }
        let is_same = |written: &String| *written == blake3::hash(&bytes).to_string();
        if !blake3.as_ref().is_none_or(is_same) {
            let problem = "its content is not what was written";
            return Err(DatasetError::invalid(&path, "blake3", problem, REMEDY));
        }
        DatasetFrame::decode(&path, &bytes, &self.description)
    }
}
