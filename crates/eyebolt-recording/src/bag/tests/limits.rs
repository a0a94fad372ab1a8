//! Small files that become large ones.

use super::mcap_writer::{channel, chunk, mcap, message, schema};
use super::support::{assert_says, file, open, scan};
use crate::bag::bag_file::LARGEST_CHUNK;
use crate::bag::bytes::Bytes;
use crate::bag::zstd::{FileLimit, Unzipper, unzip_file};
use std::io::Write;

/// Zeros, compressed; with their count in the frame or without.
fn zeros(count: u64, counted: bool) -> Vec<u8> {
    let mut encoder = zstd::stream::write::Encoder::new(Vec::new(), 1).unwrap();
    encoder.set_pledged_src_size(Some(count).filter(|_| counted)).unwrap();
    encoder.include_contentsize(counted).unwrap();
    let piece = vec![0; 1 << 20];
    let mut left = count;
    while left > 0 {
        let length = left.min(piece.len() as u64);
        encoder.write_all(&piece[..length as usize]).unwrap();
        left -= length;
    }
    encoder.finish().unwrap()
}

#[test]
fn bombs_are_refused() {
    for counted in [true, false] {
        let bomb = zeros(LARGEST_CHUNK + 1, counted);
        assert!(bomb.len() < 1 << 20, "{} bytes", bomb.len());
        let [schema, channel] = [schema(1, "std_msgs/msg/String"), channel(1, 1, "/notes")];
        for bad in [message(1, 5, &bomb), chunk("zstd", 1 << 20, &bomb)] {
            let records = [schema.clone(), channel.clone(), bad, message(1, 6, b"x")];
            let (_folder, path) = file("bomb.mcap", &mcap(&records, true));
            let (told, problems) = scan(&open(&path).unwrap());
            assert_eq!((told.len(), problems.len()), (1, 1), "{problems:?}");
        }
        let mut unzipper = Unzipper::default();
        let problem = unzipper.unzip(&bomb, None).unwrap_err();
        assert!(problem.contains("more than 256 MiB"), "{problem}");
        assert!(unzipper.into_bytes().len() as u64 <= LARGEST_CHUNK + 1);
    }
}

#[test]
fn memory_is_what_was_claimed_and_no_more() {
    // A chunk that claims less than there is.
    let bomb = zeros(64 << 20, true);
    let mut unzipper = Unzipper::default();
    assert!(unzipper.unzip(&bomb, Some(1 << 16)).is_err());
    assert!(unzipper.into_bytes().capacity() <= 1 << 16);
    let mut unzipper = Unzipper::default();
    assert!(unzipper.unzip(&bomb[..10], Some(250 << 20)).unwrap_err().contains("are never"));
    assert_eq!(unzipper.into_bytes().capacity(), 0);
}

#[test]
fn files_may_grow_by_so_much() {
    let (folder, path) = file("bag.mcap.zstd", &zeros(100_000, true));
    let stored = std::fs::metadata(&path).unwrap().len();
    let bytes = Bytes::open(&path).unwrap();
    let unzip = |always, ratio| unzip_file(&bytes, folder.path(), FileLimit { always, ratio });
    assert_eq!(unzip(100_000, 1).unwrap().as_file().metadata().unwrap().len(), 100_000);
    assert!(unzip(0, 100_000 / stored + 1).is_ok());
    assert_says(
        unzip(99_999, 1),
        &["bag.mcap.zstd: zstd: ", "decompress to more than 99999", "`zstd -d`"],
    );
    // Nothing is left behind.
    let left = std::fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(left, 1);
}
