//! Files of a folder whose names differ in one number.

use crate::error::RecordingError;
use crate::pattern::natural_order;
use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

/// Files called alike but for a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Series {
    before: String,
    after: String,
    /// The numbers, as they are spelled.
    numbers: Vec<String>,
}

/// Files that are looked at.
const MOST_FILES: usize = 1 << 20;

/// The series in `folder`, the longest first, and the names of the files that are of none.
pub(super) fn series_in(folder: &Path) -> Result<(Vec<Series>, Vec<String>), RecordingError> {
    let failed = |cause: io::Error| RecordingError::Read {
        path: folder.to_path_buf(),
        field: "the folder".to_owned(),
        remedy: "Check that it exists and may be listed".to_owned(),
        cause,
    };
    let entries = std::fs::read_dir(folder).map_err(failed)?.take(MOST_FILES).flatten();
    let files = entries.filter(|entry| entry.path().is_file());
    let mut names: Vec<String> =
        files.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.sort_by(|a, b| natural_order(a, b));
    let mut series: BTreeMap<(String, String), Vec<String>> = BTreeMap::new();
    let mut single = Vec::new();
    for name in names {
        match split(&name) {
            Some((before, number, after)) => {
                series.entry((before, after)).or_default().push(number);
            }
            None => single.push(name),
        }
    }
    let mut all: Vec<Series> = series
        .into_iter()
        .map(|((before, after), numbers)| Series { before, after, numbers })
        .collect();
    all.sort_by_key(|series| std::cmp::Reverse(series.count()));
    Ok((all, single))
}

/// What stands before and after the last number of a name, and the number.
fn split(name: &str) -> Option<(String, String, String)> {
    let (stem, ending) = name.rsplit_once('.')?;
    let is_digit = |c: char| c.is_ascii_digit();
    let end = stem.rfind(is_digit)? + 1;
    let digits = stem.get(..end)?;
    let start = digits.rfind(|c: char| !is_digit(c)).map_or(0, |at| {
        at + digits.get(at..).and_then(|rest| rest.chars().next()).map_or(1, char::len_utf8)
    });
    let (before, number) = (stem.get(..start)?, stem.get(start..end)?);
    Some((before.to_owned(), number.to_owned(), format!("{}.{ending}", stem.get(end..)?)))
}

impl Series {
    pub(super) fn count(&self) -> usize {
        self.numbers.len()
    }

    /// As a `recording.toml` names it.
    pub(super) fn pattern(&self) -> String {
        format!("{}{{}}{}", self.before, self.after)
    }

    /// What is in all of its names.
    pub(super) fn name(&self) -> &str {
        &self.before
    }

    pub(super) fn extension(&self) -> &str {
        self.after.rsplit('.').next().unwrap_or_default()
    }

    pub(super) fn first_path(&self, folder: &Path) -> PathBuf {
        let first = self.numbers.first().map_or("", String::as_str);
        folder.join(format!("{}{first}{}", self.before, self.after))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn parts_make_the_name(name in ".{0,12}") {
            if let Some((before, number, after)) = split(&name) {
                prop_assert!(!number.is_empty() && number.chars().all(|c| c.is_ascii_digit()));
                prop_assert_eq!(format!("{before}{number}{after}"), name);
            }
        }
    }

    #[test]
    fn the_last_number_is_the_frames() {
        let parts = |name: &str| split(name).map(|(before, _, after)| (before, after));
        let text = |a: &str, b: &str| Some((a.to_owned(), b.to_owned()));
        assert_eq!(parts("depth_12.png"), text("depth_", ".png"));
        assert_eq!(parts("cam1_7_depth.npy"), text("cam1_", "_depth.npy"));
        assert_eq!(parts("0.png"), text("", ".png"));
        assert_eq!(parts("arm.urdf"), None);
        assert_eq!(parts("no_ending_3"), None);
    }
}
