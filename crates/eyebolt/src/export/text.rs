//! Numbers and names in text, such that who reads them gets the same ones back.

use super::placement::Placement;

/// Numbers below this are rounding of zero; as text they would only be long.
const ZERO: f64 = 1e-15;

/// A number with a decimal point and without an exponent: PyYAML takes `1e-5` for a word and `1` for
/// an integer. As many digits as give the same number back.
pub(super) fn number(value: f64) -> String {
    if value.abs() < ZERO {
        return "0.0".to_owned();
    }
    let text = value.to_string();
    if text.contains('.') { text } else { format!("{text}.0") }
}

/// Numbers with spaces between them.
pub(super) fn numbers(values: &[f64]) -> String {
    values.iter().map(|value| number(*value)).collect::<Vec<_>>().join(" ")
}

/// A word of a POSIX shell.
pub(super) fn shell_word(text: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-./:@%+,".contains(c);
    if text.chars().all(plain) {
        text.to_owned()
    } else {
        format!("'{}'", text.replace('\'', r"'\''"))
    }
}

/// A string of Python, or a double-quoted scalar of YAML: without control characters, which names of
/// frames have not, these are written alike.
pub(super) fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', r"\\").replace('"', "\\\""))
}

/// Text in XML, in elements and in attributes of either quote.
pub(super) fn xml(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&apos;"),
            other => escaped.push(other),
        }
    }
    escaped
}

/// A name of letters, digits and underscores, as names of files and of ROS nodes may be.
pub(super) fn identifier(text: &str) -> String {
    let kept = text.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' });
    let name: String = kept.collect();
    if name.starts_with(|c: char| c.is_ascii_alphabetic()) { name } else { format!("camera{name}") }
}

/// What the numbers mean, for comments that end with the line.
pub(super) fn meaning(placement: &Placement) -> [String; 2] {
    let Placement { parent, child, .. } = placement;
    let axes = if placement.child_is_optical {
        format!("; {child} is the depth optical frame: x right, y down, z forward")
    } else {
        String::new()
    };
    [
        format!("Pose of {child} in {parent}: maps coordinates in {child} to those in {parent}."),
        format!("Metres; quaternion x y z w{axes}."),
    ]
}

/// [`meaning`] without the names, for comments in which not every name may stand.
pub(super) fn meaning_without_names(placement: &Placement) -> String {
    let axes = if placement.child_is_optical {
        " The child is the depth optical frame: x right, y down, z forward."
    } else {
        ""
    };
    format!(
        "Pose of the child in the parent: maps coordinates in the child to those in the parent. \
         Metres, radians.{axes}"
    )
}
