//! Names of recordings that no two share, and that do not depend on which other recordings there are.

use crate::dataset::file_safe;
use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

/// A recording of a batch.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Listed {
    /// Its path, as it was given but for `./` and slashes that say nothing.
    pub recording: String,
    /// In the names of its files.
    pub name: String,
}

/// Digits of a hash that tell recordings of one name apart: of a million recordings, two share them once in two
/// thousand batches, and [`listed`] would say so.
const HASH_DIGITS: usize = 12;

/// `recording` without what says nothing.
fn plain(recording: &str) -> String {
    let parts = Path::new(recording).components().filter(|part| *part != Component::CurDir);
    let path: PathBuf = parts.collect();
    match path.to_str() {
        Some(text) if !text.is_empty() => text.to_owned(),
        _ => ".".to_owned(),
    }
}

/// The name of the recording at `recording`: that of its file or folder, and a hash of the path.
pub fn name_of(recording: &str) -> String {
    let plain = plain(recording);
    let mut hash = blake3::Hasher::new_derive_key("eyebolt batch recording, version 1");
    let digits = hash.update(plain.as_bytes()).finalize().to_hex();
    let stem = Path::new(&plain).file_stem().map(|stem| stem.to_string_lossy());
    let stem = file_safe(&stem.unwrap_or_default());
    format!("{stem}-{}", digits.get(..HASH_DIGITS).unwrap_or_default())
}

/// The recordings at these paths, each once, in order of their paths.
///
/// # Errors
///
/// Two paths that have the same name.
pub fn listed<'a>(paths: impl IntoIterator<Item = &'a str>) -> Result<Vec<Listed>, [String; 2]> {
    let mut by_name: BTreeMap<String, String> = BTreeMap::new();
    for path in paths {
        let recording = plain(path);
        let other = by_name.insert(name_of(path), recording.clone());
        if let Some(other) = other.filter(|other| *other != recording) {
            return Err([other, recording]);
        }
    }
    let mut all: Vec<Listed> =
        by_name.into_iter().map(|(name, recording)| Listed { recording, name }).collect();
    all.sort();
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::{listed, name_of};
    use proptest::prelude::*;
    use proptest::test_runner::{Config, RngSeed};
    use std::collections::BTreeSet;

    fn config() -> Config {
        Config { rng_seed: RngSeed::Fixed(7), failure_persistence: None, ..Config::default() }
    }

    proptest! {
        #![proptest_config(config())]

        #[test]
        fn every_path_has_one_name_that_a_file_may_have(
            paths in prop::collection::vec(
                "(/|\\./)?[a-c.é ]{1,3}(/[a-c.é ]{1,3}){0,2}(\\.mcap)?/?",
                1..20,
            )
        ) {
            let all = listed(paths.iter().map(String::as_str)).unwrap();
            let recordings: BTreeSet<&str> = all.iter().map(|it| it.recording.as_str()).collect();
            let names: BTreeSet<&str> = all.iter().map(|it| it.name.as_str()).collect();
            prop_assert_eq!((recordings.len(), names.len()), (all.len(), all.len()));
            for path in &paths {
                // Whatever else is in the list.
                let alone = listed([path.as_str()]).unwrap().remove(0);
                prop_assert!(all.contains(&alone), "{}", path);
                prop_assert_eq!(name_of(&alone.recording), alone.name);
            }
            let safe = |c: char| c.is_ascii_alphanumeric() || "-_".contains(c);
            prop_assert!(names.iter().all(|name| name.chars().all(safe)), "{:?}", names);
            let backwards = listed(paths.iter().rev().map(String::as_str)).unwrap();
            prop_assert_eq!(backwards, all);
        }
    }

    #[test]
    fn what_says_nothing_changes_no_name_and_what_says_something_does() {
        for same in ["./a/b.mcap", "a//b.mcap", "a/./b.mcap", "a/b.mcap/"] {
            assert_eq!(name_of(same), name_of("a/b.mcap"));
        }
        for other in ["/a/b.mcap", "a/b.bag", "a/../a/b.mcap", "b.mcap"] {
            assert_ne!(name_of(other), name_of("a/b.mcap"));
        }
        assert!(name_of("a/b.mcap").starts_with("b-"));
    }
}
