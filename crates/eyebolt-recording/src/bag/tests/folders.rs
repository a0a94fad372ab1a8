//! Which files of a folder are a bag.

use super::mcap_writer::{mcap, small};
use super::support::{assert_says, file, fixture, open, scan, scan_whole, strict};
use crate::bag::{BagKind, is_bag};
use std::fs;
use std::path::Path;

fn describe(folder: &Path, files: &str) {
    let text = format!("rosbag2_bagfile_information:\n  relative_file_paths: {files}\n");
    fs::write(folder.join("metadata.yaml"), text).unwrap();
}

#[test]
fn only_files_in_the_folder_are_listed() {
    let (folder, path) = file("a.mcap", &mcap(&small(), true));
    let inner = folder.path().join("inner");
    fs::create_dir(&inner).unwrap();
    let absolute = format!("[\"{}\"]", path.display());
    for files in ["[../a.mcap]", "[./../a.mcap]", "[b.mcap]", "[..]", "['']", "[inner]", &absolute]
    {
        describe(&inner, files);
        assert_says(
            open(&inner),
            &["metadata.yaml", "is not a file in the folder", "ros2 bag reindex"],
        );
    }
    // Not even if the folder has a file of that name.
    fs::copy(&path, inner.join("a.mcap")).unwrap();
    describe(&inner, "[../a.mcap]");
    assert_says(open(&inner), &["is not a file in the folder"]);
    // Old versions wrote the folder's name before the file's.
    describe(&inner, "[inner/a.mcap]");
    assert_eq!(scan_whole(&open(&inner).unwrap()).len(), 1);
}

#[test]
fn descriptions_must_list_files() {
    let folder = tempfile::tempdir().unwrap();
    assert_says(open(folder.path()), &["no bag is in it"]);
    assert!(!is_bag(folder.path()));
    describe(folder.path(), "[]");
    assert!(is_bag(folder.path()));
    assert_says(open(folder.path()), &["no bag is in it"]);
    for text in ["", "a: b", "rosbag2_bagfile_information: 3", "[1, 2", "\u{0}"] {
        fs::write(folder.path().join("metadata.yaml"), text).unwrap();
        assert_says(open(folder.path()), &["metadata.yaml: YAML: ", "ros2 bag reindex"]);
    }
}

#[test]
fn without_a_description_one_bag_is_meant() {
    let (folder, path) = file("b.mcap", &mcap(&small(), true));
    fs::write(folder.path().join("notes.txt"), "no bag").unwrap();
    assert_eq!(scan_whole(&open(folder.path()).unwrap()).len(), 1);
    fs::copy(&path, folder.path().join("a.mcap")).unwrap();
    assert_says(open(folder.path()), &["several bags: ", "a.mcap, ", "b.mcap", "Give one of them"]);
    assert_eq!(scan_whole(&open(&path).unwrap()).len(), 1);
}

#[test]
fn files_are_what_they_begin_with() {
    // Whatever they are called.
    let (_folder, path) = file("recording.bag", &mcap(&small(), true));
    assert_eq!(open(&path).unwrap().kind(), BagKind::Mcap);
    assert_eq!(open(&fixture("sqlite_file")).unwrap().kind(), BagKind::Sqlite);
    for bytes in [&b""[..], b"SQLite", b"text of any kind"] {
        let (_folder, path) = file("other.mcap", bytes);
        assert!(!is_bag(&path));
        assert_says(open(&path), &["other.mcap: kind of file: ", "neither MCAP nor SQLite"]);
    }
    assert_says(
        open(Path::new("/no/such/file.mcap")),
        &["/no/such/file.mcap: cannot read the bag"],
    );
}

#[test]
fn compressed_files_are_called_by_their_own_names() {
    let whole = mcap(&small(), true);
    let zip = |bytes: &[u8]| zstd::bulk::compress(bytes, 1).unwrap();
    let (folder, path) = file("a.mcap.zstd", &zip(&whole));
    let scratch = tempfile::tempdir().unwrap();
    let bag = crate::bag::Bag::open(&path, scratch.path()).unwrap();
    let told = scan_whole(&bag);
    assert_eq!(bag.read(told[0].locator).unwrap(), b"hello");
    assert_eq!(fs::read_dir(scratch.path()).unwrap().count(), 1);
    drop(bag);
    assert_eq!(fs::read_dir(scratch.path()).unwrap().count(), 0);
    // Damage within is told of the compressed file, which people know.
    let cut = folder.path().join("cut.mcap.zstd");
    fs::write(&cut, zip(&mcap(&small(), false))).unwrap();
    let named = format!("{}: record at byte", cut.display());
    assert_says(strict(&open(&cut).unwrap()), &[&named]);
    assert!(scan(&open(&cut).unwrap()).1[0].contains(&named));
    fs::write(&cut, zip(b"something else")).unwrap();
    assert_says(open(&cut), &["cut.mcap.zstd: kind of file"]);
    let bytes = zip(&whole);
    for length in 4..bytes.len() {
        fs::write(&cut, &bytes[..length]).unwrap();
        assert_says(open(&cut), &["cut.mcap.zstd: "]);
    }
    assert_says(
        crate::bag::Bag::open(&path, Path::new("/no/such/folder")),
        &["/no/such/folder: cannot read a decompressed copy of the bag", "Make room there"],
    );
}
