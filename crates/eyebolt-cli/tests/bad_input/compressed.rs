//! Zstandard that unpacks to more than there is memory, or disk.

use crate::bag::{Mcap, chunk};
use crate::desk::{Desk, text};
use crate::outcome::assert_unusable;
use crate::run::{command, end, start};
use std::fs;

/// A frame of 64 MiB of zeros, in some 2 kB.
fn frame() -> Vec<u8> {
    zstd::bulk::compress(&vec![0; 64 << 20], 1).unwrap()
}

#[test]
fn a_chunk_that_unpacks_to_more_than_it_says() {
    let desk = Desk::new();
    let path = desk.file("bag.mcap");
    // 8 GiB, whatever the chunk claims.
    let packed = frame().repeat(128);
    for claimed in [0, 1000, 512 << 20] {
        let bytes = Mcap::new().with(&chunk("zstd", claimed, &packed)).finish();
        fs::write(&path, bytes).unwrap();
        assert_unusable(&path, &["bag.mcap: record at byte", "chunk", "--partial"]);
    }
}

/// Once only: 4 GiB are unpacked to the disk before it is known for what it is.
#[test]
fn a_file_that_unpacks_to_more_than_any_recording() {
    let desk = Desk::new();
    let (path, scratch) = (desk.file("bag.mcap.zstd"), desk.file("scratch"));
    fs::create_dir(&scratch).unwrap();
    fs::write(&path, frame().repeat(65)).unwrap();
    let mut info = command("", &["info", text(&path)]);
    let ended = end(start(info.env("TMPDIR", &scratch)));
    ended.assert_error(&["bag.mcap.zstd: zstd", "more than 4294967296 bytes", "no recording"]);
    assert_eq!(fs::read_dir(&scratch).unwrap().count(), 0, "the copy is removed");
}
