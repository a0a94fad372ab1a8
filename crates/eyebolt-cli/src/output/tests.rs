//! A folder that is replaced while names cannot be changed.

use super::write_folder_with;
use anyhow::Result;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A folder called `recording` with the old text, in a folder of its own.
fn desk() -> (TempDir, PathBuf) {
    let desk = tempfile::tempdir().unwrap();
    let path = desk.path().join("recording");
    fs::create_dir(&path).unwrap();
    fs::write(path.join("text"), "old").unwrap();
    (desk, path)
}

/// Writes the new text into the folder; the renames with these numbers, counted from 1, fail.
fn write(path: &Path, failing: &[usize]) -> Result<()> {
    let mut count = 0;
    let fill = |folder: &Path| Ok(fs::write(folder.join("text"), "new")?);
    write_folder_with(path, true, fill, &mut |from, to| {
        count += 1;
        match failing.contains(&count) {
            true => Err(io::ErrorKind::PermissionDenied.into()),
            false => fs::rename(from, to),
        }
    })
}

fn said(folder: &Path) -> String {
    fs::read_to_string(folder.join("text")).unwrap()
}

fn names(folder: &Path) -> Vec<PathBuf> {
    fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
}

#[test]
fn the_new_folder_takes_the_place_of_the_old() {
    let (desk, path) = desk();
    write(&path, &[]).unwrap();
    assert_eq!(said(&path), "new");
    assert_eq!(names(desk.path()), [path]);
}

#[test]
fn the_old_folder_stays_or_comes_back() {
    for failing in [1, 2] {
        let (desk, path) = desk();
        let error = write(&path, &[failing]).unwrap_err().to_string();
        assert!(error.contains("recording: cannot write: permission denied"), "{error}");
        assert_eq!(said(&path), "old", "rename {failing} fails");
        assert_eq!(names(desk.path()), [path]);
    }
}

#[test]
fn an_old_folder_that_cannot_come_back_is_kept_and_told_of() {
    let (desk, path) = desk();
    let error = write(&path, &[2, 3]).unwrap_err().to_string();
    let kept = names(desk.path());
    let [kept] = kept.as_slice() else { panic!("{kept:?}") };
    let kept = kept.join("replaced");
    assert_eq!(said(&kept), "old");
    assert!(error.contains(&format!("is in {} now", kept.display())), "{error}");
}
