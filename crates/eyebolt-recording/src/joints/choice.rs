//! Which of the names in a file are joints of the recording.

use super::positions::invalid;
use crate::error::RecordingError;
use std::collections::HashMap;
use std::path::Path;

/// Name of what says which frame a row of a table is of.
pub(super) const FRAME: &str = "frame";

/// Names of what is often beside joints, and is none.
const NO_JOINTS: [&str; 4] = [FRAME, "stamp", "time", "timestamp"];

/// Joints with their places among the keys of a file.
pub(super) type Choice = Vec<(String, usize)>;

/// Finds `names` among `keys`; without names, all keys that may be joints. `place` is where in the
/// file, for messages.
pub(super) fn choose(
    path: &Path,
    place: &str,
    keys: &[&str],
    names: Option<&[String]>,
) -> Result<Choice, RecordingError> {
    let mut places: HashMap<&str, Vec<usize>> = HashMap::new();
    for (index, key) in keys.iter().enumerate() {
        places.entry(key).or_default().push(index);
    }
    let wanted: Vec<&str> = match names {
        Some(names) => names.iter().map(String::as_str).collect(),
        None => keys.iter().filter(|key| !NO_JOINTS.contains(key)).copied().collect(),
    };
    if wanted.is_empty() {
        let problem = format!("{place}no joint is named");
        return Err(invalid(path, problem, "Name every position by its joint"));
    }
    let find = |name: &str| match places.get(name).map(Vec::as_slice) {
        _ if name.is_empty() => {
            let remedy = "Name it, or list the joints as frames.joint_names in recording.toml";
            Err(invalid(path, format!("{place}a joint has no name"), remedy))
        }
        Some([index]) => Ok((name.to_owned(), *index)),
        Some(_) => {
            let problem = format!("{place}\"{}\" is there twice", shown(name));
            Err(invalid(path, problem, "Keep the one that is right"))
        }
        None => {
            let problem = format!("{place}\"{name}\" is not among {}", list(keys));
            let remedy = "Correct frames.joint_names in recording.toml, or the names in the file";
            Err(invalid(path, problem, remedy))
        }
    };
    wanted.into_iter().map(find).collect()
}

/// Some names, for a message.
fn list(keys: &[&str]) -> String {
    const MOST: usize = 8;
    let some: Vec<_> = keys.iter().take(MOST).map(|key| format!("\"{}\"", shown(key))).collect();
    let more = if keys.len() > MOST { ", …" } else { "" };
    some.join(", ") + more
}

/// What a message shows of a text that may be long.
pub(super) fn shown(text: &str) -> String {
    const LONGEST: usize = 40;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => text.get(..end).unwrap_or_default().to_owned() + "…",
        None => text.to_owned(),
    }
}
