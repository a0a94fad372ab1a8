//! Damaged and malicious files are errors, never a panic or a large allocation.

use crate::sample::png_u16;
use crate::sample::{HEIGHT, PIXELS, Sample, WIDTH, assert_says, npy, npy_with_header, png};
use png::{BitDepth, ColorType};
use proptest::prelude::*;

/// Reads the first frame with every proper beginning of one of its files: all must be errors.
fn every_beginning_fails(sample: &Sample, name: &str) {
    let whole = sample.read(name);
    assert!(sample.frame().is_ok());
    for end in 0..whole.len() {
        sample.write(name, &whole[..end]);
        assert!(sample.frame().is_err(), "{name} cut to {end} bytes was read");
    }
}

#[test]
fn npy_cut_short() {
    every_beginning_fails(&Sample::depth(), "depth_2.npy");
    every_beginning_fails(&Sample::depth(), "joints_2.npy");
    every_beginning_fails(&Sample::cloud(), "xyz_2.npy");
}

#[test]
fn png_cut_short() {
    let sample = Sample::depth();
    sample.describe("depth_{}.npy", "depth_{}.png");
    sample.describe("\"m\"", "\"mm\"");
    for name in ["depth_2.png", "depth_10.png"] {
        sample.write(name, &png_u16(WIDTH, HEIGHT, &[700; PIXELS]));
    }
    for name in ["depth_2.png", "mask_2.png"] {
        // The trailer after the last pixel may be missing.
        let whole = sample.read(name);
        for end in 0..whole.len() {
            sample.write(name, &whole[..end]);
            let result = sample.frame();
            assert!(result.is_err() || end + 16 >= whole.len(), "{name} cut to {end} was read");
        }
        sample.write(name, &whole);
    }
}

#[test]
fn text_cut_short() {
    for name in ["recording.toml", "camera_info.yaml"] {
        let sample = Sample::depth();
        let whole = sample.read(name);
        let mut wrong = 0;
        for end in 0..whole.len() {
            sample.write(name, &whole[..end]);
            wrong += usize::from(sample.frame().is_err());
        }
        // Cutting off what is optional leaves a recording.
        assert!(wrong > whole.len() / 2, "{name}: {wrong} of {} cuts refused", whole.len());
    }
}

#[test]
fn headers_that_lie() {
    let sample = Sample::depth();
    for shape in [&[usize::MAX, usize::MAX][..], &[1 << 40, 1 << 20], &[3, 5], &[3, 3], &[0, 4]] {
        sample.write("depth_2.npy", &npy("<f4", false, shape, &[0; 4 * PIXELS]));
        assert_says(sample.frame(), &["depth_2.npy", "shape", "48 bytes", "damaged"]);
    }
    let nested = "(".repeat(60_000);
    for header in [
        "",
        "{",
        "{}",
        "{'descr': '<f4'}",
        "{'descr': '<f4', 'fortran_order': 1, 'shape': (3, 4)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (-3, 4)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (3 4)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (99999999999999999999999, 4)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (1,1,1,1,1,1,1,1,1,1,1,1)}",
        "{'descr': '<f4' 'fortran_order': False, 'shape': (3, 4)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 4)} + 1",
        "{'descr': '<é', 'fortran_order': False, 'shape': (3, 4), 'more': 1}",
        &nested,
    ] {
        sample.write("depth_2.npy", &npy_with_header(header, &[0; 4 * PIXELS]));
        assert_says(sample.frame(), &["depth_2.npy", "header is not"]);
    }
    sample.write("depth_2.npy", b"\x93NUMPY\x02\x00\xff\xff\xff\xff{'descr'");
    assert_says(sample.frame(), &["depth_2.npy", "ends in its header"]);
    sample.write("depth_2.npy", b"\x93NUMPY\x09\x00\xff\xff");
    assert_says(sample.frame(), &["depth_2.npy", "version 9"]);
}

/// A PNG with another size in its header, and the checksum that belongs to it.
fn resized(png: &[u8], width: u32, height: u32) -> Vec<u8> {
    let mut bytes = png.to_vec();
    bytes[16..20].copy_from_slice(&width.to_be_bytes());
    bytes[20..24].copy_from_slice(&height.to_be_bytes());
    let mut crc = u32::MAX;
    for byte in &bytes[12..29] {
        crc ^= u32::from(*byte);
        for _ in 0..8 {
            crc = if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 };
        }
    }
    bytes[29..33].copy_from_slice(&(!crc).to_be_bytes());
    bytes
}

#[test]
fn pictures_that_claim_to_be_huge() {
    let sample = Sample::depth();
    let small = png(WIDTH, HEIGHT, ColorType::Grayscale, BitDepth::Eight, &[255; PIXELS]);
    sample.write("mask_2.png", &resized(&small, 1 << 30, 1 << 30));
    assert_says(sample.frame(), &["mask_2.png", "100 megapixels"]);
    // A camera of that size too: the picture is refused for the few bytes that it has.
    let sample = Sample::cloud();
    sample.describe("cloud = \"xyz_{}.npy\"\ncloud_frame = \"optical\"", "depth = \"d_{}.png\"");
    sample.describe("\"m\"", "\"mm\"");
    sample.describe("[frames]", "[camera]\ninfo = \"camera_info.yaml\"\n[frames]");
    let info = crate::sample::CAMERA_INFO.replace("width: 4", "width: 9000");
    sample.write("camera_info.yaml", info.replace("height: 3", "height: 9000").as_bytes());
    let depth = png_u16(WIDTH, HEIGHT, &[700; PIXELS]);
    for name in ["d_2.png", "d_10.png"] {
        sample.write(name, &resized(&depth, 9000, 9000));
    }
    assert_says(sample.frame(), &["d_2.png", "cannot hold", "damaged"]);
}

#[test]
fn files_that_are_too_large() {
    let sample = Sample::depth();
    // A hole in the file takes no room on the disk.
    std::fs::File::create(sample.file("depth_2.npy")).unwrap().set_len((512 << 20) + 1).unwrap();
    assert_says(sample.frame(), &["depth_2.npy", "512 MiB"]);
    std::fs::File::create(sample.file("camera_info.yaml")).unwrap().set_len(2 << 20).unwrap();
    assert_says(sample.open(), &["camera_info.yaml", "1 MiB"]);
}

#[test]
fn text_that_is_none() {
    let sample = Sample::depth();
    sample.write("camera_info.yaml", b"width: \xff");
    assert_says(sample.open(), &["camera_info.yaml", "byte 7 is not UTF-8"]);
    let deep = "[".repeat(100_000);
    sample.write("camera_info.yaml", deep.as_bytes());
    assert_says(sample.open(), &["camera_info.yaml"]);
    sample.write("recording.toml", format!("a = {deep}").as_bytes());
    assert_says(sample.open(), &["recording.toml", "line 1"]);
    sample.write("recording.toml", &[0xff]);
    assert_says(sample.open(), &["recording.toml", "UTF-8"]);
}

proptest! {
    // Every case writes a folder.
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn changed_bytes_never_panic(
        which in 0_usize..5,
        changes in proptest::collection::vec((any::<proptest::sample::Index>(), any::<u8>()), 1..4),
    ) {
        let sample = Sample::depth();
        let files =
            ["depth_2.npy", "joints_2.npy", "mask_2.png", "recording.toml", "camera_info.yaml"];
        let mut bytes = sample.read(files[which]);
        for (index, value) in changes {
            let at = index.index(bytes.len());
            bytes[at] = value;
        }
        sample.write(files[which], &bytes);
        let _ = sample.frame();
    }
}
