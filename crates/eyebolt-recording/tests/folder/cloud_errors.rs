//! Damaged and malicious clouds, and those that are not what they seem.

use crate::clouds::{bits, fixtures, pcd, ply, with_cloud};
use crate::sample::assert_says;
use eyebolt_recording::{Frame, FrameSource, RecordingError};
use proptest::prelude::*;
use std::fs;

const POINTS: [[f32; 3]; 2] = [[500.0; 3], [400.0, 2.0, 700.0]];

fn fixture(name: &str) -> Vec<u8> {
    fs::read(fixtures().join(name)).unwrap()
}

fn frame(name: &str, bytes: &[u8]) -> Result<Frame, RecordingError> {
    with_cloud(name.rsplit('.').next().unwrap(), bytes).frame()
}

/// A PCD in text of which `from` has become `to`.
#[track_caller]
fn pcd_says(from: &str, to: &str, parts: &[&str]) {
    let text = pcd(&POINTS);
    assert!(text.contains(from), "no {from}");
    let parts: Vec<_> = parts.iter().chain(&["xyz_2.pcd"]).copied().collect();
    assert_says(frame("a.pcd", text.replacen(from, to, 1).as_bytes()), &parts);
}

/// A PLY in text of which `from` has become `to`.
#[track_caller]
fn ply_says(from: &str, to: &str, parts: &[&str]) {
    let text = ply(&POINTS);
    assert!(text.contains(from), "no {from}");
    let parts: Vec<_> = parts.iter().chain(&["xyz_2.ply"]).copied().collect();
    assert_says(frame("a.ply", text.replacen(from, to, 1).as_bytes()), &parts);
}

#[test]
fn clouds_cut_short() {
    for name in [
        "grid_mixed_ascii.pcd",
        "grid_mixed_binary.pcd",
        "grid_mixed_binary_compressed.pcd",
        "grid_padded_binary.pcd",
        "grid_f4_ascii.ply",
        "list_f4_big.ply",
        "grid_mixed_ascii.ply",
        "grid_mixed_little.ply",
    ] {
        let bytes = fixture(name);
        let whole = bits(&frame(name, &bytes).unwrap());
        let extension = name.rsplit('.').next().unwrap();
        let sample = with_cloud(extension, &bytes);
        let folder = sample.open().unwrap();
        for end in 0..bytes.len() {
            sample.write(&format!("xyz_2.{extension}"), &bytes[..end]);
            let Ok(frame) = folder.read_frame(0) else { continue };
            // Faces may be missing, and the last digits of text: all points must be there.
            let points = bits(&frame);
            assert_eq!(points.len(), whole.len(), "{name} cut to {end}");
            assert_eq!(points[..11], whole[..11], "{name} cut to {end}");
            let text = name.contains("ascii") && end + 20 > bytes.len();
            assert!(text || extension == "ply", "{name} cut to {end} was read");
        }
    }
}

#[test]
fn pcd_headers_are_understood() {
    pcd_says(".7", "1.0", &["VERSION", "\"1.0\"", "0.7"]);
    pcd_says("VERSION", "VERSIONS", &["\"VERSIONS .7\"", "no PCD header"]);
    pcd_says("SIZE 4 4 4", "SIZE 4 4", &["SIZE", "2 values for 3 FIELDS"]);
    pcd_says("SIZE 4 4 4", "SIZE 4 4 3", &["SIZE", "\"3\" is not known"]);
    pcd_says("SIZE 4 4 4", "SIZE 4 4 2", &["FIELDS", "z is 1 of type F2", "SIZE 4 or 8"]);
    pcd_says("TYPE F F F", "TYPE F F I", &["FIELDS", "z is 1 of type I4"]);
    pcd_says("TYPE F F F", "TYPE F F X", &["TYPE", "\"X\" is not known"]);
    pcd_says("TYPE F F F", "TYPE F F F\nTYPE F F F", &["TYPE", "twice"]);
    pcd_says("WIDTH", "COUNT 1 1 0\nWIDTH", &["COUNT", "\"0\""]);
    pcd_says("WIDTH", "COUNT 1 1 2\nWIDTH", &["FIELDS", "z is 2 of type F4"]);
    pcd_says("x y z", "x y normal_z", &["FIELDS", "x y normal_z", "expected x, y and z"]);
    pcd_says("x y z", "x y y", &["FIELDS", "y is there twice"]);
    pcd_says("FIELDS x y z\n", "", &["FIELDS", "missing"]);
    pcd_says("WIDTH 2\nPOINTS 2\n", "", &["WIDTH", "missing"]);
    pcd_says("WIDTH 2", "WIDTH two", &["WIDTH", "\"two\"", "whole number"]);
    pcd_says("WIDTH 2", "WIDTH -2", &["WIDTH", "\"-2\""]);
    pcd_says("WIDTH 2", "WIDTH 2\nHEIGHT 2", &["POINTS", "2, but WIDTH x HEIGHT is 2 x 2"]);
    pcd_says("ascii", "text", &["DATA", "\"text\"", "binary_compressed"]);
    pcd_says("DATA ascii\n", "", &["\"500 500 500\"", "no PCD header"]);
    let long = format!("VERSION .7\n{}", "#\n".repeat(40_000));
    pcd_says("VERSION .7\n", &long, &["ends in its header"]);
    assert_says(frame("a.pcd", &fixture("grid_f4_ascii.ply")), &["\"ply\"", "no PCD header"]);
}

#[test]
fn sensors_elsewhere_are_refused() {
    let remedy = "VIEWPOINT 0 0 0 1 0 0 0";
    pcd_says("WIDTH", "VIEWPOINT 0 0 1.5 1 0 0 0\nWIDTH", &["VIEWPOINT", "[0, 0, 1.5]", remedy]);
    pcd_says("WIDTH", "VIEWPOINT 0 0 0 0.6 0.8 0 0\nWIDTH", &["VIEWPOINT", "0.6, 0.8", remedy]);
    pcd_says("WIDTH", "VIEWPOINT 0 0 0 0 0 0 0\nWIDTH", &["VIEWPOINT", "turned by", remedy]);
    pcd_says("WIDTH", "VIEWPOINT 0 0 nan 1 0 0 0\nWIDTH", &["VIEWPOINT", "NaN", remedy]);
    pcd_says("WIDTH", "VIEWPOINT 0 0 0 1 0 0\nWIDTH", &["VIEWPOINT", "not 7 numbers", remedy]);
}

#[test]
fn pcd_points_are_those_of_the_header() {
    pcd_says("400 2 700", "400 2", &["line 9", "found 2 numbers, expected 3"]);
    pcd_says("400 2 700", "400 2 700 1", &["line 9", "found 4 numbers, expected 3"]);
    pcd_says("400 2 700", "400 2 7OO", &["line 9", "\"7OO\" is not a number"]);
    pcd_says("400 2 700", "400 2 700\n1 1 1", &["POINTS is 2, but 3 follow", "damaged"]);
    pcd_says("400 2 700\n", "", &["POINTS is 2, but 1 follow"]);
    pcd_says("WIDTH 2\nPOINTS 2", "WIDTH 99", &["cannot hold 99 points", "damaged"]);
    let huge = "WIDTH 65536\nHEIGHT 65535";
    pcd_says("WIDTH 2\nPOINTS 2", huge, &["4294901760 points", "thin the cloud"]);
    let huge = "WIDTH 65536\nHEIGHT 65536";
    pcd_says("WIDTH 2\nPOINTS 2", huge, &["POINTS", "too many"]);
    let counts = format!("FIELDS x y z f\nSIZE 4 4 4 8\nTYPE F F F U\nCOUNT 1 1 1 {}", u64::MAX);
    let header = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F";
    pcd_says(header, &counts, &["COUNT", "too large"]);
    let counts = counts.replace(&u64::MAX.to_string(), "1000000000000000000");
    pcd_says(header, &counts, &["cannot hold 2 points"]);
    let mut binary = fixture("grid_f4_binary.pcd");
    binary.push(b'\n');
    assert!(frame("a.pcd", &binary).is_ok());
    binary.push(7);
    assert_says(frame("a.pcd", &binary), &["12 points of 12 bytes", "146 bytes", "damaged"]);
}

#[test]
fn compressed_sizes_that_lie() {
    let name = "grid_f4_binary_compressed.pcd";
    let bytes = fixture(name);
    let key = b"DATA binary_compressed\n";
    let start = bytes.windows(key.len()).position(|window| window == key).unwrap() + key.len();
    let packed = u32::from_le_bytes(*bytes[start..].first_chunk().unwrap());
    let sized = |packed: u32, size: u32| {
        let mut bytes = bytes.clone();
        bytes[start..start + 4].copy_from_slice(&packed.to_le_bytes());
        bytes[start + 4..start + 8].copy_from_slice(&size.to_le_bytes());
        frame(name, &bytes)
    };
    assert!(sized(packed, 144).is_ok());
    assert_says(sized(packed, u32::MAX), &["12 points of 12 bytes", "4294967295 bytes"]);
    assert_says(sized(u32::MAX, 144), &["take 4294967295 bytes", "follow", "damaged"]);
    assert_says(sized(packed + 1, 144), &["but", "follow", "damaged"]);
    assert_says(sized(packed - 1, 144), &["end within a run", "damaged"]);
    assert_says(sized(0, 144), &["0 compressed bytes cannot hold 144"]);
    // PCL leaves zeros behind the compressed points.
    let longer = [bytes.clone(), vec![0; 99]].concat();
    assert!(frame(name, &longer).is_ok());
    // A reference to what was before the first byte.
    let mut back = bytes.clone();
    back[start + 8] = 1 << 5;
    assert_says(frame(name, &back), &["before the first byte", "damaged"]);
}

#[test]
fn ply_headers_are_understood() {
    ply_says("ply\n", "plyx\n", &["begin with \"ply\""]);
    ply_says("ascii 1.0", "ascii 1.1", &["header", "line 2", "not understood"]);
    ply_says("ascii 1.0", "text 1.0", &["line 2", "\"text\" is not known"]);
    ply_says("format ascii 1.0\n", "", &["line of the format is missing"]);
    ply_says("element vertex 2", "element vertex two", &["line 3", "\"two\""]);
    ply_says("element vertex", "element point", &["no element vertex"]);
    ply_says("element", "element vertex 1\nelement", &["line 4", "\"vertex\"", "twice"]);
    ply_says("element", "property int a\nelement", &["line 3", "\"a\"", "no element"]);
    ply_says("float z", "float x", &["header", "property x", "twice"]);
    ply_says("float z", "float nz", &["no z"]);
    ply_says("float z", "int z", &["z", "neither float nor double"]);
    ply_says("float z", "list uchar float z", &["z", "neither float nor double"]);
    ply_says("float z", "half z", &["line 6", "\"half\""]);
    ply_says("float z", "float z\nproperty list float int l", &["line 7", "length"]);
    ply_says("end_header\n", "", &["line 7", "\"500 500 500\""]);
    let long = format!("{}end_header", "comment\n".repeat(9000));
    ply_says("end_header", &long, &["ends in its header"]);
}

#[test]
fn ply_records_are_those_of_the_header() {
    ply_says("400 2 700", "400 2", &["line 9", "vertex 1", "fewer numbers"]);
    ply_says("400 2 700", "400 2 700 1", &["line 9", "vertex 1", "more numbers"]);
    ply_says("400 2 700", "400 2 7OO", &["vertex 1", "\"7OO\" is not a number"]);
    ply_says("vertex 2", "vertex 9000000", &["cannot hold 9000000 vertices", "damaged"]);
    ply_says("vertex 2", "vertex 99000000", &["99000000 points", "thin the cloud"]);
    let list = "float z\nproperty list int int l";
    let first = ply(&POINTS).replace("500 500 500", "500 500 500 0").replace("float z", list);
    let endless = first.replace("700", "700 4000000000 1");
    assert!(frame("a.ply", first.replace("700", "700 2 1 1").as_bytes()).is_ok());
    assert_says(frame("a.ply", endless.as_bytes()), &["vertex 1", "fewer numbers"]);
    let negative = endless.replace("4000000000", "-1");
    assert_says(frame("a.ply", negative.as_bytes()), &["vertex 1", "\"-1\"", "length"]);
    // Elements of no bytes come without end.
    let nothing = format!("element nothing {}\nelement vertex", u64::MAX);
    let text = ply(&POINTS).replacen("element vertex", &nothing, 1);
    assert!(frame("a.ply", text.as_bytes()).is_ok());
    let many = nothing.replace("\nelement v", "\nproperty list char int a\nelement v");
    let many = ply(&POINTS).replacen("element vertex", &many, 1);
    let many = many.replace("500 500 500", "2 500 500").replace("400 2", "1");
    assert_says(frame("a.ply", many.as_bytes()), &["nothing 2", "the file ends before it"]);
}

#[test]
fn ply_lists_in_bytes_that_lie() {
    let header = "ply\nformat binary_big_endian 1.0\nelement a 1\nproperty list int double l\n\
                  element vertex 0\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
    let with = |length: i32| frame("a.ply", &[header.as_bytes(), &length.to_be_bytes()].concat());
    // All is well with it, but that there are no points.
    assert_says(with(0), &["it has no point"]);
    assert_says(with(-1), &["a 0", "negative"]);
    assert_says(with(1), &["a 0", "the file ends within it"]);
    assert_says(with(i32::MAX), &["a 0", "the file ends within it"]);
}

proptest! {
    // Every case writes a folder.
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn changed_bytes_never_panic(
        which in 0_usize..8,
        changes in proptest::collection::vec((any::<proptest::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let names = [
            "grid_mixed_ascii.pcd", "grid_mixed_binary.pcd", "grid_mixed_binary_compressed.pcd",
            "grid_unpadded_binary_compressed.pcd", "list_old_ascii.pcd", "grid_mixed_ascii.ply",
            "grid_mixed_little.ply", "grid_mixed_big.ply",
        ];
        let mut bytes = fixture(names[which]);
        for (index, value) in changes {
            let at = index.index(bytes.len());
            bytes[at] = value;
        }
        let _ = frame(names[which], &bytes);
    }
}
