//! NPY files that are odd, and NPY files that lie.

use crate::depth::shape;
use crate::folder::{GOOD, Recorded, SHOTS};
use crate::outcome::{assert_unusable, trusted};
use crate::recording::npy_f32;
use std::fs::File;

/// Odd, and to be read as what it is.
#[test]
fn the_first_axis_fastest_makes_no_difference() {
    let recorded = Recorded::all();
    let [rows, columns] = shape();
    for (frame, shot) in SHOTS.iter().enumerate() {
        let by_columns = (0..columns).flat_map(|u| (0..rows).map(move |v| v * columns + u));
        let depth_m: Vec<f32> = by_columns.map(|at| shot.depth_m[at]).collect();
        let bytes = said(&npy_f32(&shape(), &depth_m), "False,", "True, ");
        recorded.write(&format!("depth_{frame}.npy"), &bytes);
    }
    assert_eq!(trusted(recorded.path()), *GOOD);
}

#[test]
fn numbers_of_a_type_that_depth_is_not() {
    let recorded = Recorded::two();
    recorded.write("depth_1.npy", &said(&recorded.read("depth_1.npy"), "'<f4'", "'<i4'"));
    let words = ["depth_1.npy: depth", "'<i4'", "Store one of float32, float64, uint16"];
    assert_unusable(recorded.path(), &words);
}

#[test]
fn a_header_that_claims_more_numbers_than_follow() {
    let recorded = Recorded::two();
    for rows in ["999", "99999999999999999"] {
        let header = said(&npy_f32(&shape(), &[]), "(240, 424, )", &format!("({rows}, 424, )"));
        recorded.write("depth_1.npy", &header);
        let words = ["depth_1.npy: depth", rows, "damaged or cut short: copy or write it again"];
        assert_unusable(recorded.path(), &words);
    }
}

#[test]
fn a_file_of_many_gigabytes() {
    let recorded = Recorded::two();
    let file = File::options().write(true).open(recorded.path().join("depth_1.npy")).unwrap();
    // Nothing but length: no disk is needed.
    file.set_len(100 << 30).unwrap();
    let words = ["depth_1.npy: depth", "larger than 512 MiB", "Name the right file"];
    assert_unusable(recorded.path(), &words);
}

/// The file with `from` in its header replaced by `to`, and the header's length made right.
#[track_caller]
fn said(npy: &[u8], from: &str, to: &str) -> Vec<u8> {
    let length = usize::from(u16::from_le_bytes([npy[8], npy[9]]));
    let (header, numbers) = npy[10..].split_at(length);
    let header = str::from_utf8(header).unwrap();
    assert!(header.contains(from), "{header}");
    let header = header.replace(from, to);
    let mut bytes = npy[..8].to_vec();
    bytes.extend(u16::try_from(header.len()).unwrap().to_le_bytes());
    bytes.extend(header.bytes());
    bytes.extend(numbers);
    bytes
}
