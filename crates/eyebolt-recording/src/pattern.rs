//! Patterns of file names with one `{}`, and the frames that they match.

use crate::error::RecordingError;
use std::cmp::Ordering;
use std::path::{Path, PathBuf};

/// The place of the frame's name in a pattern.
const PLACE: &str = "{}";

/// A path with `{}` once, in its file name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Pattern {
    folder: PathBuf,
    before: String,
    after: String,
    extension: String,
}

impl Pattern {
    /// From the text of `field` in the file `manifest`, relative to its folder `root`.
    pub(crate) fn parse(
        manifest: &Path,
        root: &Path,
        field: &str,
        text: &str,
        extensions: &[&str],
    ) -> Result<Self, RecordingError> {
        let wrong = |problem: String, remedy: &str| {
            RecordingError::invalid(manifest, field, problem, remedy)
        };
        let path = root.join(text);
        let name = path.file_name().and_then(|n| n.to_str()).unwrap_or_default();
        let Some((before, after)) = name.split_once(PLACE) else {
            let problem = format!("\"{text}\" has no {{}} in its file name");
            return Err(wrong(problem, "Write {} where the frame's number or name stands"));
        };
        if after.contains(PLACE) || text.matches(PLACE).count() > 1 {
            let problem = format!("\"{text}\" has more than one {{}}");
            return Err(wrong(problem, "Write {} once, in the file name"));
        }
        let extension = after.rsplit_once('.').map(|(_, e)| e.to_ascii_lowercase());
        let extension = extension.unwrap_or_default();
        if !extensions.contains(&extension.as_str()) {
            let problem = format!("\"{text}\" is of a kind that is not read here");
            return Err(wrong(
                problem,
                &format!("Use files that end in .{}", extensions.join(" or .")),
            ));
        }
        let folder = path.parent().unwrap_or(root).to_path_buf();
        Ok(Self { folder, before: before.to_owned(), after: after.to_owned(), extension })
    }

    /// The file of frame `name`.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.join(format!("{}{name}{}", self.before, self.after))
    }

    /// Where the files are.
    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }

    /// The file name with its `{}`.
    pub(crate) fn file_name(&self) -> String {
        format!("{}{PLACE}{}", self.before, self.after)
    }

    /// How the files end, in lower case, without the dot.
    pub(crate) fn extension(&self) -> &str {
        &self.extension
    }

    /// The frame that `file_name` belongs to, if it fits the pattern.
    fn frame<'a>(&self, file_name: &'a str) -> Option<&'a str> {
        let name = file_name.strip_prefix(&*self.before)?.strip_suffix(&*self.after)?;
        (!name.is_empty()).then_some(name)
    }

    /// The frames in the folder, sorted so that 2 comes before 10. `field` is for messages.
    pub(crate) fn frames(&self, field: &str) -> Result<Vec<String>, RecordingError> {
        let failed = |cause| RecordingError::Read {
            path: self.folder.clone(),
            field: format!("the folder of {field}"),
            remedy: format!("Correct {field} in recording.toml"),
            cause,
        };
        let mut names = Vec::new();
        for entry in std::fs::read_dir(&self.folder).map_err(failed)? {
            let file_name = entry.map_err(failed)?.file_name();
            // The manifest is UTF-8, so no other name can be meant.
            names.extend(file_name.to_str().and_then(|n| self.frame(n)).map(str::to_owned));
        }
        names.sort_by(|a, b| natural_order(a, b));
        Ok(names)
    }
}

/// How the name of the file at `path` ends, in lower case, without the dot.
pub(crate) fn extension(path: &Path) -> String {
    path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase()
}

/// Compares runs of digits as numbers and the rest as text; equal only if the texts are.
pub(crate) fn natural_order(a: &str, b: &str) -> Ordering {
    let (mut left, mut right) = (a, b);
    while !left.is_empty() && !right.is_empty() {
        let (l, left_rest) = first_run(left);
        let (r, right_rest) = first_run(right);
        let number = |s: &str| s.starts_with(|c: char| c.is_ascii_digit());
        let order = if number(l) && number(r) {
            let (l, r) = (l.trim_start_matches('0'), r.trim_start_matches('0'));
            l.len().cmp(&r.len()).then_with(|| l.cmp(r))
        } else {
            l.cmp(r)
        };
        if order != Ordering::Equal {
            return order;
        }
        (left, right) = (left_rest, right_rest);
    }
    left.len().cmp(&right.len()).then_with(|| a.cmp(b))
}

/// Splits off the leading digits, or the text up to the first digit.
fn first_run(text: &str) -> (&str, &str) {
    let digits = text.starts_with(|c: char| c.is_ascii_digit());
    let end = text.find(|c: char| c.is_ascii_digit() != digits).unwrap_or(text.len());
    text.split_at_checked(end).unwrap_or((text, ""))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn numbers_sort_as_numbers(a in 0_u32..2000, b in 0_u32..2000) {
            let (left, right) = (format!("f{a}_x"), format!("f{b}_x"));
            prop_assert_eq!(natural_order(&left, &right), a.cmp(&b));
        }

        #[test]
        fn order_is_total(mut names in proptest::collection::vec("[ab0-9]{0,6}", 0..12)) {
            names.sort_by(|a, b| natural_order(a, b));
            for (i, a) in names.iter().enumerate() {
                for b in names.iter().skip(i) {
                    prop_assert_ne!(natural_order(a, b), Ordering::Greater);
                    prop_assert_eq!(natural_order(a, b) == Ordering::Equal, a == b);
                }
            }
        }

        #[test]
        fn a_frame_finds_itself(name in "[a-z0-9_.]{1,9}") {
            let root = Path::new("r");
            let pattern = Pattern::parse(root, root, "f", "depth_{}.npy", &["npy"]).unwrap();
            let path = pattern.path(&name);
            prop_assert_eq!(pattern.frame(path.file_name().unwrap().to_str().unwrap()), Some(&*name));
        }
    }
}
