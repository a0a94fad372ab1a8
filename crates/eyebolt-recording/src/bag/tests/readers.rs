//! Bags that are no files: in memory, behind a reader that counts, read by several threads.

use super::support::{assert_says, fixture, open, scan_whole};
use crate::bag::Bag;
use crate::bag::bytes::Bytes;
use std::io::{Cursor, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

fn from_memory(bytes: Vec<u8>) -> Result<Bag, crate::RecordingError> {
    Bag::from_reader(Path::new("memory"), Cursor::new(bytes), &std::env::temp_dir())
}

/// Whole bags of every kind that needs no file, with chunks of every compression and without.
const BAGS: [&str; 8] = [
    "none.mcap",
    "lz4.mcap",
    "zstd.mcap",
    "unchunked.mcap",
    "../ros1_none.bag",
    "../ros1_bz2.bag",
    "../ros1_lz4.bag",
    "../ros1_roslz4.bag",
];

fn bags() -> impl Iterator<Item = PathBuf> {
    BAGS.into_iter().map(fixture)
}

#[test]
fn a_bag_in_memory_has_what_the_file_has() {
    for path in bags() {
        let in_file = open(&path).unwrap();
        let in_memory = from_memory(std::fs::read(&path).unwrap()).unwrap();
        let told = scan_whole(&in_file);
        assert_eq!(scan_whole(&in_memory), told, "{}", path.display());
        for message in &told {
            assert_eq!(in_memory.read(message.locator).unwrap(), message.data);
        }
        assert_eq!(in_memory.metadata(), in_file.metadata());
        assert_eq!(in_memory.kind(), in_file.kind());
    }
}

#[test]
fn errors_say_what_a_reader_is_called() {
    assert_says(from_memory(b"no bag at all, but words".to_vec()), &["memory: kind of file"]);
    let text = b"SQLite format 3\0 and more".to_vec();
    assert_says(from_memory(text), &["memory", "files only", "Give the file's path"]);
}

#[test]
fn a_bag_compressed_as_a_whole_comes_from_memory_too() {
    for path in bags() {
        let plain = std::fs::read(path).unwrap();
        let zipped = zstd::bulk::compress(&plain, 1).unwrap();
        let told = scan_whole(&from_memory(plain).unwrap());
        assert_eq!(scan_whole(&from_memory(zipped).unwrap()), told);
    }
}

#[test]
fn threads_read_the_same_messages_at_the_same_time() {
    for path in bags() {
        for bag in [open(&path).unwrap(), from_memory(std::fs::read(&path).unwrap()).unwrap()] {
            let told = scan_whole(&bag);
            std::thread::scope(|scope| {
                for first in 0..4 {
                    let (bag, told) = (&bag, &told);
                    scope.spawn(move || {
                        for message in told.iter().skip(first).chain(told.iter().take(first)) {
                            assert_eq!(bag.read(message.locator).unwrap(), message.data);
                        }
                    });
                }
            });
        }
    }
}

/// Files are opened once.
#[cfg(unix)]
#[test]
fn a_file_that_was_opened_is_read_though_its_name_is_gone() {
    for name in bags() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bag");
        std::fs::copy(&name, &path).unwrap();
        let bag = open(&path).unwrap();
        std::fs::remove_file(&path).unwrap();
        for message in scan_whole(&bag) {
            assert_eq!(bag.read(message.locator).unwrap(), message.data, "{}", name.display());
        }
    }
}

/// A database is opened once for reading, too.
#[cfg(unix)]
#[test]
fn a_database_that_was_scanned_is_read_though_its_name_is_gone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bag.db3");
    std::fs::copy(fixture("sqlite/sqlite.db3"), &path).unwrap();
    let bag = open(&path).unwrap();
    let told = scan_whole(&bag);
    std::fs::remove_file(&path).unwrap();
    for message in told {
        assert_eq!(bag.read(message.locator).unwrap(), message.data);
    }
}

/// Gives a byte at a time, as sockets may.
struct Slow(Cursor<Vec<u8>>);

impl Read for Slow {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        let most = into.len().min(1);
        self.0.read(&mut into[..most])
    }
}

impl Seek for Slow {
    fn seek(&mut self, to: SeekFrom) -> std::io::Result<u64> {
        self.0.seek(to)
    }
}

#[test]
fn readers_of_bytes_have_places_of_their_own() {
    let bytes = Bytes::from_reader(Path::new("slow"), Slow(Cursor::new((0..9).collect()))).unwrap();
    assert_eq!(bytes.length(), 9);
    let (mut one, mut other) = (bytes.reader(1), bytes.reader(5));
    let (mut first, mut second) = ([0; 2], [0; 2]);
    one.read_exact(&mut first).unwrap();
    other.read_exact(&mut second).unwrap();
    assert_eq!((first, second), ([1, 2], [5, 6]));
    assert_eq!(one.seek(SeekFrom::Current(-3)).unwrap(), 0);
    assert_eq!(one.seek(SeekFrom::End(-1)).unwrap(), 8);
    assert!(one.seek(SeekFrom::Current(-9)).is_err());
    let mut rest = Vec::new();
    one.read_to_end(&mut rest).unwrap();
    assert_eq!(rest, [8]);
}
