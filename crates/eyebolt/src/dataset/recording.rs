//! `recordings/ID.toml`: where frames came from.

use super::error::DatasetError;
use super::files::{check_place, read_text};
use eyebolt_recording::{FrameSource, RecordingError};
use eyebolt_robot::Arm;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// A recording whose frames are in a data set.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct RecordingEntry {
    /// In the names of its files: its own name, and a hash of what is in it.
    pub id: String,
    /// Name of its file or folder.
    pub source: String,
    /// How many frames at rest it has.
    pub frames: usize,
    /// Whether its masks of the arm were used.
    pub masks: bool,
    /// File of the calibration, in the data set's folder.
    pub calibration: String,
    /// Where the calibration is from.
    pub calibrated: Calibrated,
}

/// Where a calibration is from.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Calibrated {
    /// Found in the same recording, from nothing.
    FromNothing,
    /// Somebody gave it.
    Given,
}

/// Bytes of a hash that tell recordings of one name apart.
const HASH_DIGITS: usize = 10;

impl RecordingEntry {
    /// Of `source`, whose file is called `name`; the same wherever the file lies.
    ///
    /// # Errors
    ///
    /// Joints that cannot be read.
    pub fn new(
        name: &str,
        source: &dyn FrameSource,
        arm: &Arm,
        masks: bool,
        calibrated: Calibrated,
    ) -> Result<Self, RecordingError> {
        let mut hash = blake3::Hasher::new_derive_key("eyebolt data set recording, version 1");
        hash.update(arm.robot().urdf_hash().as_bytes());
        for (index, name) in source.frame_names().iter().enumerate() {
            hash.update(name.as_bytes()).update(&[0]);
            for (joint, position) in source.read_joints(index)?.iter() {
                hash.update(joint.as_bytes()).update(&position.to_le_bytes());
            }
        }
        let digits = hash.finalize().to_hex();
        let digits = digits.get(..HASH_DIGITS).unwrap_or_default();
        let stem = Path::new(name).file_stem().map(|stem| stem.to_string_lossy());
        let id = format!("{}-{digits}", file_safe(&stem.unwrap_or_default()));
        Ok(Self {
            calibration: format!("recordings/{id}.calibration.json"),
            id,
            source: name.to_owned(),
            frames: source.frame_names().len(),
            masks: masks && source.has_masks(),
            calibrated,
        })
    }

    /// From the file at `path`.
    pub(super) fn read(path: &Path) -> Result<Self, DatasetError> {
        let remedy = "Remove the file and label the recording again: frames that are whole stay";
        let entry: Self = toml::from_str(&read_text(path, remedy)?).map_err(|error| {
            let problem = toml::de::Error::message(&error).to_owned();
            DatasetError::invalid(path, "text", problem, remedy)
        })?;
        check_place(path, &entry.calibration)?;
        Ok(entry)
    }

    /// Where frame `number`, called `name`, goes in the data set's folder.
    pub(super) fn frame_file(&self, number: usize, name: &str) -> String {
        format!("frames/{}/{number:06}_{}.npz", self.id, file_safe(name))
    }
}

/// Longest part of a file's name that is taken from outside.
const MOST_NAME: usize = 60;

/// `name` of letters, digits and dashes.
pub(crate) fn file_safe(name: &str) -> String {
    let safe = |c: char| if c.is_ascii_alphanumeric() || "-_".contains(c) { c } else { '_' };
    name.chars().take(MOST_NAME).map(safe).collect()
}
