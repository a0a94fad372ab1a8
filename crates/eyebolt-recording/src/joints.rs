//! Joint positions in NPY, CSV and JSON.

mod choice;
mod csv;
mod json;
mod npy;
mod positions;
mod table;

pub(crate) use positions::{check, looks_like_degrees};

use crate::error::RecordingError;
use crate::file::{read_long_text, read_text};
use crate::manifest::{JointFiles, Manifest};
use crate::pattern::{Pattern, extension};
use eyebolt_robot::JointPositions;
use positions::FIELD;
use std::path::Path;
use table::Table;

/// Largest file with the joints of all frames, bytes: some 50 000 frames of CSV, or 10 000
/// messages of ROS in JSON. Hostile text of that size makes 30 times as much of memory.
const TABLE_LIMIT: u64 = 8 << 20;

/// Where the positions of every frame come from.
#[derive(Clone, Debug)]
pub(crate) enum Joints {
    /// Files, to be read when a frame is asked for.
    PerFrame(Pattern),
    /// Memory, one after the other in the order of the frames.
    Table(Vec<JointPositions>),
}

impl Joints {
    /// Reads the table of the joints, if there is one, for frames of these names.
    pub(crate) fn open(manifest: &Manifest, frames: &[String]) -> Result<Self, RecordingError> {
        let path = match &manifest.joints {
            JointFiles::PerFrame(pattern) => return Ok(Self::PerFrame(pattern.clone())),
            JointFiles::Table(path) => path,
        };
        let text = read_long_text(path, FIELD, TABLE_LIMIT)?;
        let names = manifest.joint_names.as_deref();
        let mut table = Table::new(path, frames);
        match extension(path).as_str() {
            "json" => json::read_table(&text, names, &mut table)?,
            _ => csv::read_table(&text, names, &mut table)?,
        }
        table.finish().map(Self::Table)
    }

    /// The files, if there is one for every frame.
    pub(crate) fn files(&self) -> Option<&Pattern> {
        match self {
            Self::PerFrame(pattern) => Some(pattern),
            Self::Table(_) => None,
        }
    }
}

/// Reads the positions of one frame from its own file.
pub(crate) fn read_joints(
    path: &Path,
    extension: &str,
    names: Option<&[String]>,
) -> Result<JointPositions, RecordingError> {
    match extension {
        "csv" => csv::read(path, &read_text(path, FIELD)?, names),
        "json" => json::read(path, &read_text(path, FIELD)?, names),
        // The description has been refused if it has no names for these.
        _ => npy::read(path, names.unwrap_or_default()),
    }
}
