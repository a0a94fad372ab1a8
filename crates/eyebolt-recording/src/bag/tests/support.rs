//! Bags opened and scanned to the end.

use crate::bag::{Bag, Locator};
use crate::error::RecordingError;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A message as a scan told it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Told {
    pub(super) topic: String,
    pub(super) message_type: String,
    pub(super) log_time_ns: i64,
    pub(super) data: Vec<u8>,
    pub(super) locator: Locator,
}

pub(super) fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/bags").join(name)
}

pub(super) fn open(path: &Path) -> Result<Bag, RecordingError> {
    Bag::open(path, &std::env::temp_dir())
}

/// All messages, and what is wrong, of a scan that goes on behind damage.
pub(super) fn scan(bag: &Bag) -> (Vec<Told>, Vec<String>) {
    let (mut told, mut problems) = (Vec::new(), Vec::new());
    let end = bag.scan(
        &mut |locator, message| {
            told.push(Told {
                topic: message.topic.name.clone(),
                message_type: message.topic.message_type.clone(),
                log_time_ns: message.log_time_ns,
                data: message.data.to_vec(),
                locator,
            });
            Ok(())
        },
        &mut |error| {
            problems.push(error.to_string());
            Ok(())
        },
    );
    // Where nothing can be read on.
    problems.extend(end.err().map(|error| error.to_string()));
    (told, problems)
}

/// All messages of a bag that must be whole.
pub(super) fn scan_whole(bag: &Bag) -> Vec<Told> {
    let (told, problems) = scan(bag);
    assert_eq!(problems, Vec::<String>::new());
    told
}

/// How a scan ends that does not want to go on behind damage.
pub(super) fn strict(bag: &Bag) -> Result<(), RecordingError> {
    bag.scan(&mut |_, _| Ok(()), &mut Err)
}

/// A folder with one file of these bytes.
pub(super) fn file(name: &str, bytes: &[u8]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    (folder, path)
}

#[track_caller]
pub(super) fn assert_says<T>(result: Result<T, RecordingError>, parts: &[&str]) {
    let Err(error) = result else { panic!("no error, expected one with {parts:?}") };
    let text = error.to_string();
    for part in parts {
        assert!(text.contains(part), "no {part:?} in: {text}");
    }
}
