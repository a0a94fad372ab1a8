//! Chunks that lie, or have lies in them.

use super::super::support::{bag, scan, scan_whole};
use super::super::writer::{chunk, compressed, message, true_chunk, unindexed};
use super::between::{REST, camera, problem_of};
use crate::bag::LARGEST_CHUNK;

#[test]
fn chunks_that_lie_about_their_size() {
    let contents = message(0, [5, 0], &[7; 1000]);
    let size = contents.len();
    for compression in ["bz2", "lz4"] {
        let stored = compressed(compression, &contents);
        let short = problem_of(&chunk(compression, size - 1, &stored));
        assert_eq!(short, format!("it has more than the {} bytes that are declared", size - 1));
        let long = problem_of(&chunk(compression, size + 1, &stored));
        assert_eq!(long, format!("it has {size} bytes where {} are declared", size + 1));
        let lost = problem_of(&chunk(compression, size, &stored[..stored.len() / 2]));
        assert!(lost.starts_with("it ca") || lost.starts_with("it has "), "{lost}");
        let large = usize::try_from(LARGEST_CHUNK + 1).unwrap();
        let large = problem_of(&chunk(compression, large, &stored));
        assert!(large.starts_with("268435457 bytes are too many for a chunk. Record"), "{large}");
    }
    let uncompressed = problem_of(&chunk("none", size + 1, &contents));
    assert_eq!(uncompressed, format!("a chunk of {size} bytes says that it has {}", size + 1));
    let unknown = problem_of(&chunk("zstd", size, &contents));
    assert_eq!(unknown, "compression \"zstd\" is not known (none, bz2, lz4 are)");
}

#[test]
fn bombs_are_not_unpacked() {
    let zeros = vec![0; 64 << 20];
    for compression in ["bz2", "lz4"] {
        let stored = compressed(compression, &zeros);
        assert!(stored.len() < 1 << 20, "{}", stored.len());
        let bomb = problem_of(&chunk(compression, 1000, &stored));
        assert_eq!(bomb, "it has more than the 1000 bytes that are declared");
    }
}

#[test]
fn frames_behind_the_first_are_not_decompressed() {
    // Of another block size, which must not meet the buffers of the first.
    let contents = message(0, [5, 0], &[7; 1000]);
    let second = compressed("lz4", &vec![1; 1 << 20]);
    let stored = [compressed("lz4", &contents), second].concat();
    let records = [camera(), chunk("lz4", contents.len(), &stored)];
    assert_eq!(scan_whole(&bag(&unindexed(&records)).1).len(), 1);
}

#[test]
fn damage_in_a_chunk_ends_at_the_chunk() {
    let good = message(0, [5, 0], b"c");
    for (bad, problem) in [
        (vec![9, 0, 0, 0, 1], "its chunk ends within it"),
        (vec![0; 40], "its chunk ends within it"),
        (b"\x06\0\0\0\x02\0\0\0op\xff\xff\xff\xff".to_vec(), "its chunk ends within it"),
        (message(0, [0, 0], b"x")[..40].to_vec(), "its chunk ends within it"),
        (message(3, [0, 0], b"x"), "it belongs to connection 3, which is not told"),
        (true_chunk("none", b""), "it is a chunk in a chunk"),
    ] {
        for compression in ["bz2", "lz4"] {
            let inside = true_chunk(compression, &[good.clone(), bad.clone()].concat());
            let records = [camera(), inside, message(0, [6, 0], b"d")];
            let (messages, problems) = scan(&bag(&unindexed(&records)).1);
            let data: Vec<_> = messages.iter().map(|m| m.data.as_slice()).collect();
            assert_eq!(data, [b"c", b"d"], "{problems:?}");
            let (at, chunk) = (good.len(), unindexed(&[camera()]).len());
            let field = format!("record at byte {at} of the chunk at byte {chunk}: {problem}");
            assert_eq!(problems.len(), 1);
            assert!(problems[0].ends_with(&format!("{field}. {REST}")), "{problems:?}");
        }
        let inside = true_chunk("none", &[good.clone(), bad].concat());
        let records = [camera(), inside, message(0, [6, 0], b"d")];
        let (messages, problems) = scan(&bag(&unindexed(&records)).1);
        let data: Vec<_> = messages.iter().map(|m| m.data.as_slice()).collect();
        assert_eq!((data, problems.len()), (vec![&b"c"[..], b"d"], 1));
    }
}
