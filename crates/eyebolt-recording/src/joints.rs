//! Joint positions in NPY, CSV and JSON.

mod choice;
mod csv;
mod json;
mod npy;
mod table;

use crate::error::RecordingError;
use crate::file::{read_long_text, read_text};
use crate::manifest::{JointFiles, Manifest};
use crate::pattern::{Pattern, extension};
use eyebolt_robot::JointPositions;
use std::f64::consts::PI;
use std::path::Path;
use table::Table;

const FIELD: &str = "joints";

/// No joint of an arm turns further, radians.
const LARGEST_RAD: f64 = 4.0 * PI;

/// Largest file with the joints of all frames, bytes: some 50 000 frames of CSV, or 10 000
/// messages of ROS in JSON. Hostile text of that size makes 30 times as much of memory.
const TABLE_LIMIT: u64 = 8 << 20;

/// Most names in a file: no arm has as many joints, and no table as many columns.
const MOST_NAMES: usize = 1000;

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

fn invalid(path: &Path, problem: impl Into<String>, remedy: &str) -> RecordingError {
    RecordingError::invalid(path, FIELD, problem, remedy)
}

/// One position per name, radians (metres for prismatic joints), if all are plausible; `place` is
/// where in the file, for messages.
fn positions(
    path: &Path,
    place: &str,
    pairs: Vec<(String, f64)>,
) -> Result<JointPositions, RecordingError> {
    for (name, position) in &pairs {
        check(path, FIELD, place, name, *position)?;
    }
    Ok(pairs.into_iter().collect())
}

/// One position for each of `names`, which are all that is known of numbers without names.
fn in_order(
    path: &Path,
    names: &[String],
    numbers: Vec<f64>,
) -> Result<JointPositions, RecordingError> {
    let (count, expected) = (numbers.len(), names.len());
    if count != expected {
        return Err(invalid(
            path,
            format!("the file has {count} positions, but joint_names has {expected} names"),
            "Correct frames.joint_names in recording.toml: one name per position, in their order",
        ));
    }
    positions(path, "", names.iter().cloned().zip(numbers).collect())
}

/// Refuses what cannot be the position of a joint of an arm; `field` is where it stands, `place`
/// where in it.
pub(crate) fn check(
    path: &Path,
    field: &str,
    place: &str,
    name: &str,
    position: f64,
) -> Result<(), RecordingError> {
    let (problem, remedy) = if !position.is_finite() {
        (
            format!("{place}the position of {name} is {position}"),
            "Record the frame again, or leave it out",
        )
    } else if looks_like_degrees(position) {
        (
            format!("{place}the position of {name} is {position}, which looks like degrees"),
            "Store radians (and metres for prismatic joints)",
        )
    } else {
        return Ok(());
    };
    Err(RecordingError::invalid(path, field, problem, remedy))
}

/// Whether no joint of an arm turns so far.
pub(crate) fn looks_like_degrees(position: f64) -> bool {
    position.abs() > LARGEST_RAD
}
