//! From TOML text to a struct, with a hint for keys that nobody knows.

use crate::error::RecordingError;
use serde::de::DeserializeOwned;
use std::path::Path;

/// Sections with their keys.
const KNOWN: [(&str, &[&str]); 4] = [
    ("camera", &["info", "tf_static"]),
    (
        "frames",
        &["depth", "cloud", "depth_unit", "cloud_frame", "color", "mask", "joints", "joint_names"],
    ),
    ("background", &["depth", "depth_unit"]),
    ("robot", &["urdf", "base", "end_effector"]),
];

/// The value of type `T` that `text` of the file at `path` spells.
pub(super) fn parse<T: DeserializeOwned>(path: &Path, text: &str) -> Result<T, RecordingError> {
    let failed = |error: toml::de::Error| {
        let start = error.span().map_or(0, |span| span.start);
        let before = text.get(..start).unwrap_or_default();
        let line = before.matches('\n').count() + 1;
        let remedy = "Correct it as TOML; texts are in quotes, sections in [brackets]";
        RecordingError::invalid(path, format!("line {line}"), error.message().trim_end(), remedy)
    };
    // Keys first: serde's own message lists the known ones but does not say which was meant.
    check_keys(path, &toml::from_str(text).map_err(failed)?)?;
    toml::from_str(text).map_err(failed)
}

fn check_keys(path: &Path, table: &toml::Table) -> Result<(), RecordingError> {
    let sections = KNOWN.map(|(section, _)| section);
    for (section, value) in table {
        let Some((_, keys)) = KNOWN.iter().find(|(known, _)| known == section) else {
            return Err(unknown(path, section, section, "", &sections));
        };
        for key in value.as_table().into_iter().flat_map(toml::Table::keys) {
            if !keys.contains(&key.as_str()) {
                return Err(unknown(path, &format!("{section}.{key}"), key, section, keys));
            }
        }
    }
    Ok(())
}

fn unknown(path: &Path, field: &str, key: &str, section: &str, known: &[&str]) -> RecordingError {
    let nearest = known.iter().map(|k| (distance(key, k), *k)).min();
    // A key mostly unlike every other is no slip of the pen.
    let hint = nearest.filter(|(d, k)| *d <= k.len().max(3) / 2);
    let place = if section.is_empty() { String::new() } else { format!(" in [{section}]") };
    let remedy = match hint {
        Some((_, nearest)) => {
            format!("Did you mean \"{nearest}\"? Known{place}: {}", known.join(", "))
        }
        None => format!("Remove it; known{place}: {}", known.join(", ")),
    };
    RecordingError::invalid(path, field, "the key is not known", remedy)
}

/// How many letters to insert, remove or replace to make `b` of `a` (Levenshtein).
fn distance(a: &str, b: &str) -> usize {
    // The known keys are short, so whatever is longer than this is far from all of them.
    const ENOUGH: usize = 64;
    let mut row: Vec<usize> = (0..=b.chars().count()).collect();
    for (i, from) in a.chars().take(ENOUGH).enumerate() {
        let mut diagonal = i;
        let mut left = i + 1;
        for (slot, to) in row.iter_mut().zip(std::iter::once(None).chain(b.chars().map(Some))) {
            let Some(to) = to else {
                *slot = left;
                continue;
            };
            let changed = diagonal + usize::from(from != to);
            diagonal = *slot;
            left = changed.min(diagonal + 1).min(left + 1);
            *slot = left;
        }
    }
    row.last().copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn known_distances() {
        assert_eq!(distance("kitten", "sitting"), 3);
        assert_eq!(distance("", "abc"), 3);
        assert_eq!(distance("depht", "depth"), 2);
    }

    proptest! {
        #[test]
        fn distance_is_a_metric(a in "[abc]{0,6}", b in "[abc]{0,6}", c in "[abc]{0,6}") {
            prop_assert_eq!(distance(&a, &b), distance(&b, &a));
            prop_assert_eq!(distance(&a, &b) == 0, a == b);
            prop_assert!(distance(&a, &c) <= distance(&a, &b) + distance(&b, &c));
        }
    }
}
