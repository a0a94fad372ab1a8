//! Joints in JSON: an object of positions by name, or a `sensor_msgs/JointState` of ROS.

mod object;

use super::choice::{FRAME, choose, shown};
use super::positions::{invalid, positions};
use super::table::Table;
use crate::error::RecordingError;
use eyebolt_robot::JointPositions;
use object::{Entries, Object, Value};
use serde::de::DeserializeOwned;
use std::path::Path;

const REMEDY: &str = "Write {\"joint\": radians, …}, or {\"name\": […], \"position\": […]}";

/// Reads the text of one frame's file.
pub(super) fn read(
    path: &Path,
    text: &str,
    names: Option<&[String]>,
) -> Result<JointPositions, RecordingError> {
    joints(path, "", &parse(path, text, REMEDY)?, names)
}

/// Reads the text of a file of all frames into `table`.
pub(super) fn read_table(
    text: &str,
    names: Option<&[String]>,
    table: &mut Table<'_>,
) -> Result<(), RecordingError> {
    const REMEDY: &str = "Write {\"frame\": joints, …}, or [{\"frame\": \"name\", …}, …]";
    let path = table.path;
    let entries: Entries = parse(path, text, REMEDY)?;
    for (number, (key, object)) in (1_usize..).zip(entries.0) {
        let place = format!("entry {number}: ");
        let frame = key.or_else(|| object.get(FRAME).and_then(Value::as_name));
        let frame = frame.ok_or_else(|| {
            let problem = format!("{place}no \"frame\" with a name or number");
            invalid(path, problem, REMEDY)
        })?;
        let Some(index) = table.frame(&frame, &place)? else { continue };
        let joints = joints(path, &place, &object, names)?;
        table.fill(index, place, joints);
    }
    Ok(())
}

fn parse<T: DeserializeOwned>(path: &Path, text: &str, remedy: &str) -> Result<T, RecordingError> {
    // Some editors begin files with a mark of their encoding.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.trim_ascii().is_empty() {
        return Err(invalid(path, "the file is empty", remedy));
    }
    serde_json::from_str(text).map_err(|error| invalid(path, error.to_string(), remedy))
}

/// The joints of an object; `place` is where in the file, for messages.
fn joints(
    path: &Path,
    place: &str,
    object: &Object,
    names: Option<&[String]>,
) -> Result<JointPositions, RecordingError> {
    let keys: Vec<&str>;
    let values: Vec<Option<f64>>;
    match (object.get("name"), object.get("position")) {
        (Some(Value::List(name)), Some(Value::List(position))) => {
            if name.len() != position.len() {
                let (n, p) = (name.len(), position.len());
                let problem = format!("{place}name has {n} entries, but position has {p}");
                return Err(invalid(path, problem, "Store messages that have positions"));
            }
            // What is no text is no name, and is refused as such.
            keys = name.iter().map(|value| value.as_text().unwrap_or_default()).collect();
            values = position.iter().map(Value::as_number).collect();
        }
        _ => {
            keys = object.0.iter().map(|(key, _)| key.as_str()).collect();
            values = object.0.iter().map(|(_, value)| value.as_number()).collect();
        }
    }
    let number = |(name, index): (String, usize)| match values.get(index).copied().flatten() {
        Some(number) => Ok((name, number)),
        None => {
            let problem = format!("{place}the position of {} is not a number", shown(&name));
            Err(invalid(path, problem, REMEDY))
        }
    };
    let pairs: Result<Vec<_>, _> =
        choose(path, place, &keys, names)?.into_iter().map(number).collect();
    positions(path, place, pairs?)
}
