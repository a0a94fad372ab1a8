//! Clouds in PCD and PLY are the clouds that were stored.

use crate::sample::{HEIGHT, PIXELS, Sample, WIDTH, npy};
use eyebolt_recording::{Frame, Range};
use proptest::prelude::*;
use std::fs;
use std::path::PathBuf;

/// Files of one cloud in millimetres, with a script that made them beside it.
pub fn fixtures() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fixtures/clouds"))
}

/// A recording in millimetres whose first cloud has these bytes.
pub fn with_cloud(extension: &str, bytes: &[u8]) -> Sample {
    let sample = Sample::cloud();
    sample.describe("mask = \"mask_{}.png\"\n", "");
    sample.describe("xyz_{}.npy", &format!("xyz_{{}}.{extension}"));
    sample.describe("\"m\"", "\"mm\"");
    sample.write(&format!("xyz_2.{extension}"), bytes);
    sample
}

/// Bits of the points: those of NaN are not equal to themselves.
pub fn bits(frame: &Frame) -> Vec<[u32; 3]> {
    let Range::Cloud(cloud) = &frame.range else { panic!("no cloud") };
    cloud.points().iter().map(|p| [p.x, p.y, p.z].map(f32::to_bits)).collect()
}

#[test]
fn every_form_is_the_same_cloud() {
    let array = fs::read(fixtures().join("xyz.npy")).unwrap();
    let expected = bits(&with_cloud("npy", &array).frame().unwrap());
    assert_eq!(expected.iter().filter(|p| f32::from_bits(p[0]).is_nan()).count(), 1);
    let mut read = 0;
    for entry in fs::read_dir(fixtures()).unwrap() {
        let path = entry.unwrap().path();
        let extension = path.extension().unwrap().to_str().unwrap();
        let name = path.file_name().unwrap().to_str().unwrap();
        let frame = with_cloud(extension, &fs::read(&path).unwrap()).frame();
        let frame = frame.unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(bits(&frame), expected, "{name}");
        let grid = (!name.starts_with("list_")).then_some((WIDTH as u32, HEIGHT as u32));
        assert_eq!(frame.range.size(), grid, "{name}");
        read += 1;
    }
    assert_eq!(read, 32);
}

/// A PCD of one row in text.
pub fn pcd(points: &[[f32; 3]]) -> String {
    let n = points.len();
    let rows: String = points.iter().map(|[x, y, z]| format!("{x} {y} {z}\n")).collect();
    format!(
        "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH {n}\nPOINTS {n}\nDATA ascii\n{rows}"
    )
}

/// A PLY in text.
pub fn ply(points: &[[f32; 3]]) -> String {
    let n = points.len();
    let rows: String = points.iter().map(|[x, y, z]| format!("{x} {y} {z}\n")).collect();
    let axes = "property float x\nproperty float y\nproperty float z";
    format!("ply\nformat ascii 1.0\nelement vertex {n}\n{axes}\nend_header\n{rows}")
}

proptest! {
    // Every case writes folders.
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn units_and_frames_are_those_of_arrays(
        xyz in proptest::collection::vec([200_f32..900.0, -900_f32..900.0, -900_f32..900.0], PIXELS),
        body in any::<bool>(),
        metres in any::<bool>(),
    ) {
        let xyz: Vec<_> = xyz.iter().map(|p| p.map(|c| if metres { c * 1e-3 } else { c })).collect();
        let bytes: Vec<u8> = xyz.as_flattened().iter().flat_map(|v| v.to_le_bytes()).collect();
        let read = |extension: &str, bytes: &[u8]| {
            let sample = with_cloud(extension, bytes);
            if body {
                sample.describe("optical", "body");
            }
            if metres {
                sample.describe("\"mm\"", "\"m\"");
            }
            bits(&sample.frame().unwrap())
        };
        let expected = read("npy", &npy("<f4", false, &[PIXELS, 3], &bytes));
        prop_assert_eq!(&read("pcd", pcd(&xyz).as_bytes()), &expected);
        prop_assert_eq!(&read("ply", ply(&xyz).as_bytes()), &expected);
    }
}

#[test]
fn headers_of_the_oldest_files() {
    let points = [[500.0; 3], [1.0, 2.0, 700.0]];
    let expected = bits(&with_cloud("pcd", pcd(&points).as_bytes()).frame().unwrap());
    let rows = "500 500 500\n\n  1\t2 700  ";
    for header in [
        "COLUMNS x y z\nPOINTS 2",
        "FIELDS x y z\nWIDTH 2",
        "# a\nFIELDS x y z\n\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n# b\nVIEWPOINT 0 0 0 -1 0 0 0",
    ] {
        let text = format!("{header}\nDATA ascii\n{rows}");
        assert_eq!(bits(&with_cloud("pcd", text.as_bytes()).frame().unwrap()), expected);
    }
}

#[test]
fn what_is_no_number_is_no_point() {
    for word in ["nan", "-nan", "NaN", "-nan(ind)", "inf", "-Infinity"] {
        let rows = [[1.0, 2.0, 777.0], [500.0; 3]];
        for (extension, text) in [("pcd", pcd(&rows)), ("ply", ply(&rows))] {
            let text = text.replace("777", word);
            let bits = bits(&with_cloud(extension, text.as_bytes()).frame().unwrap());
            assert!(f32::from_bits(bits[0][0]).is_nan() && f32::from_bits(bits[1][0]) == 0.5);
        }
    }
}

#[test]
fn scans_without_some_of_their_pixels_have_no_grid() {
    let text = ply(&[[500.0; 3]; 4]);
    for (grid, expected) in [
        ("num_cols 2\nobj_info num_rows 2", Some((2, 2))),
        ("num_cols 2\nobj_info num_rows 3", None),
        ("num_cols 4\nobj_info num_rows 1", None),
        ("num_cols four\nobj_info num_rows 1", None),
    ] {
        let text = text.replace("element", &format!("obj_info {grid}\nelement"));
        let frame = with_cloud("ply", text.as_bytes()).frame().unwrap();
        assert_eq!(frame.range.size(), expected);
    }
}

#[test]
fn files_of_the_openni_grabbers_are_in_the_frame_that_is_told() {
    let points = [[500.0; 3], [1.0, 2.0, 700.0]];
    let text = pcd(&points);
    let grabbed = text.replace("WIDTH", "VIEWPOINT 0 0 0 0 1 0 0\nWIDTH");
    let read = |text: &str| bits(&with_cloud("pcd", text.as_bytes()).frame().unwrap());
    assert_eq!(read(&grabbed), read(&text));
}

#[test]
fn files_that_are_padded_to_a_page_are_read() {
    let path = fixtures().join("grid_f4_binary.pcd");
    let mut bytes = fs::read(&path).unwrap();
    let whole = bits(&with_cloud("pcd", &bytes).frame().unwrap());
    bytes.resize(bytes.len().next_multiple_of(4096), 0);
    assert_eq!(bits(&with_cloud("pcd", &bytes).frame().unwrap()), whole);
    // What is not zero is no padding, nor is more than a page.
    *bytes.last_mut().unwrap() = 1;
    assert!(with_cloud("pcd", &bytes).frame().is_err());
    *bytes.last_mut().unwrap() = 0;
    bytes.resize(1 << 20, 0);
    assert!(with_cloud("pcd", &bytes).frame().is_err());
}
