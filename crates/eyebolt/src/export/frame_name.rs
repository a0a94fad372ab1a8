//! Names of frames that every format can carry.

use eyebolt_geometry::CoordinateFrame;
use std::fmt;

/// Any frame of tf, where which one is known from the [`FrameName`] beside the transform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Named;

impl CoordinateFrame for Named {
    const NAME: &'static str = "named";
}

/// Name of a frame of tf: not empty, without control characters, and nothing that a consumer would
/// read as something else than a name.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FrameName(String);

/// A name that is none.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}. {}", self.found(), Self::REMEDY)]
pub struct BadFrameName {
    name: String,
    problem: &'static str,
}

impl BadFrameName {
    /// What to do about it.
    pub(super) const REMEDY: &str = "Rename the frame where it is published";

    /// The name and what is wrong with it.
    pub(super) fn found(&self) -> String {
        format!("frame name {:?}: {}", self.name, self.problem)
    }
}

impl FrameName {
    /// Checks a name. A slash at its front is dropped, as tf2 does with names of the first tf.
    ///
    /// # Errors
    /// A name that is empty or longer than 256 bytes, has a control character or a line break,
    /// starts with a dash, or has `:=`, `$(` or `${` in it.
    pub fn new(name: &str) -> Result<Self, BadFrameName> {
        let bare = name.strip_prefix('/').unwrap_or(name);
        match problem(bare) {
            None => Ok(Self(bare.to_owned())),
            Some(problem) => {
                // Enough to recognise it by.
                Err(BadFrameName { name: name.chars().take(64).collect(), problem })
            }
        }
    }

    /// The name.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

fn problem(name: &str) -> Option<&'static str> {
    // U+2028 and U+2029 break lines in YAML; the last three are in no XML or YAML text.
    let unprintable = |c: char| {
        c.is_control()
            || matches!(c, '\u{2028}' | '\u{2029}' | '\u{feff}' | '\u{fffe}' | '\u{ffff}')
    };
    if name.is_empty() {
        Some("it is empty")
    } else if name.len() > 256 {
        Some("it is longer than 256 bytes")
    } else if name.contains(unprintable) {
        Some("it has a line break or another control character")
    } else if name.starts_with('-') {
        Some("programs would take the dash at its front for an option")
    } else if name.contains(":=") {
        Some("ROS would take := for a remapping")
    } else if name.contains("$(") || name.contains("${") {
        Some("roslaunch or xacro would replace what follows the $")
    } else {
        None
    }
}

impl fmt::Display for FrameName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Most names that one message lists.
const MOST_LISTED: usize = 40;

/// The names for a person to read.
pub(super) fn listed<'n>(names: impl IntoIterator<Item = &'n FrameName>) -> String {
    let names: Vec<&str> = names.into_iter().map(FrameName::as_str).collect();
    match names.get(..MOST_LISTED) {
        _ if names.is_empty() => "no other frame".to_owned(),
        Some(first) if names.len() > MOST_LISTED => {
            format!("{} and {} more", first.join(", "), names.len() - MOST_LISTED)
        }
        _ => names.join(", "),
    }
}
