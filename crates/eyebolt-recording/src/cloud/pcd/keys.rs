//! The lines of a PCD header, of a key and its values each, up to `DATA`.

use crate::cloud::stored::{damaged, invalid};
use crate::cloud::text::{Lines, excerpt};
use crate::error::RecordingError;
use std::collections::BTreeMap;
use std::path::Path;

/// Keys that a header may have, `DATA` last.
const KEYS: [&str; 10] = [
    "VERSION",
    "FIELDS",
    "SIZE",
    "TYPE",
    "COUNT",
    "WIDTH",
    "HEIGHT",
    "VIEWPOINT",
    "POINTS",
    "DATA",
];

pub(super) const REWRITE: &str = "Write the file with PCL, or as NPY";

/// Keys with the text of their values.
pub(super) struct Keys<'a> {
    path: &'a Path,
    values: BTreeMap<&'static str, &'a str>,
}

impl<'a> Keys<'a> {
    /// Reads `lines` up to the one of `DATA`.
    pub(super) fn parse(path: &'a Path, lines: &mut Lines<'a>) -> Result<Self, RecordingError> {
        let mut values = BTreeMap::new();
        for line in lines.by_ref().filter(|line| !line.starts_with(b"#")) {
            let text = str::from_utf8(line).unwrap_or_default();
            let (word, value) =
                text.split_once(|c: char| c.is_ascii_whitespace()).unwrap_or((text, ""));
            // The name that the format had before version .5.
            let word = if word == "COLUMNS" { "FIELDS" } else { word };
            let Some(key) = KEYS.into_iter().find(|key| *key == word) else {
                let problem = format!("the line \"{}\" is of no PCD header", excerpt(line));
                return Err(invalid(path, problem, REWRITE));
            };
            if values.insert(key, value.trim_ascii()).is_some() {
                let problem = "the line is there twice";
                return Err(RecordingError::invalid(path, key, problem, REWRITE));
            }
            if key == "DATA" {
                return Ok(Self { path, values });
            }
        }
        Err(damaged(path, "the file ends in its header, before DATA"))
    }

    pub(super) fn invalid(
        &self,
        key: &str,
        problem: impl Into<String>,
        remedy: &str,
    ) -> RecordingError {
        RecordingError::invalid(self.path, key, problem, remedy)
    }

    /// The text after `key`, if there is such a line.
    pub(super) fn get(&self, key: &str) -> Option<&'a str> {
        self.values.get(key).copied()
    }

    /// The number after `key`, if there is such a line.
    pub(super) fn number(&self, key: &'static str) -> Result<Option<u32>, RecordingError> {
        let Some(text) = self.get(key) else { return Ok(None) };
        text.parse().map(Some).map_err(|_| {
            let problem = format!("\"{}\" is not a whole number", excerpt(text.as_bytes()));
            self.invalid(key, problem, REWRITE)
        })
    }

    /// The `count` values of the line of `key`; `absent` for each where there is no such line.
    pub(super) fn column<T>(
        &self,
        key: &'static str,
        absent: &str,
        count: usize,
        value: impl Fn(&str) -> Option<T>,
    ) -> Result<Vec<T>, RecordingError> {
        let text = self
            .get(key)
            .map_or_else(|| [absent].repeat(count), |text| text.split_ascii_whitespace().collect());
        if text.len() != count {
            let problem = format!("{} values for {count} FIELDS", text.len());
            return Err(self.invalid(key, problem, REWRITE));
        }
        let parse = |word: &&str| {
            value(word).ok_or_else(|| {
                let problem = format!("\"{}\" is not known", excerpt(word.as_bytes()));
                self.invalid(key, problem, REWRITE)
            })
        };
        text.iter().map(parse).collect()
    }
}
