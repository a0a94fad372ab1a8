//! Masks, the camera, and PNG files that lie about their size.

use crate::folder::Recorded;
use crate::outcome::assert_unusable;
use crate::scene::CAMERA;
use std::io::Write;

fn grey(width: u32, height: u32, value: u8) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Grayscale);
    let pixels = vec![value; (width * height) as usize];
    encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
    bytes
}

#[test]
fn an_empty_mask() {
    let recorded = Recorded::two();
    recorded.write("mask_1.png", &grey(CAMERA.width(), CAMERA.height(), 0));
    assert_unusable(recorded.path(), &["mask_1.png: mask", "no pixel is set", "Mark the arm"]);
}

#[test]
fn a_mask_of_another_size() {
    let recorded = Recorded::two();
    recorded.write("mask_1.png", &grey(CAMERA.width() / 2, CAMERA.height() / 2, 255));
    let words = ["mask_1.png: mask", "212 x 120", "424 x 240", "must be of the same camera"];
    assert_unusable(recorded.path(), &words);
}

#[test]
fn a_camera_of_another_size() {
    let recorded = Recorded::two();
    recorded.replace("camera_info.yaml", "width: 424", "width: 640");
    recorded.replace("camera_info.yaml", "height: 240", "height: 480");
    let words = ["depth_0.npy: depth", "240 x 424", "camera_info.yaml", "480 x 640", "same camera"];
    assert_unusable(recorded.path(), &words);
}

#[test]
fn a_camera_without_focal_length() {
    let recorded = Recorded::two();
    recorded.replace("camera_info.yaml", "k: [306.0, 0.0", "k: [0.0, 0.0");
    let words = ["camera_info.yaml: k", "focal length", "not calibrated", "Calibrate it"];
    assert_unusable(recorded.path(), &words);
}

#[test]
fn a_png_that_claims_more_pixels_than_any_camera_has() {
    let recorded = Recorded::two();
    recorded.write("mask_1.png", &with_size(grey(4, 4, 255), 100_000, 100_000));
    assert_unusable(recorded.path(), &["mask_1.png: mask", "100000 x 100000", "scale the picture"]);
}

#[test]
fn a_png_that_claims_more_pixels_than_its_bytes_can_hold() {
    let recorded = Recorded::two();
    recorded.replace("camera_info.yaml", "width: 424", "width: 9000");
    recorded.replace("camera_info.yaml", "height: 240", "height: 9000");
    recorded.replace("recording.toml", "depth_{}.npy", "depth_{}.png");
    recorded.replace("recording.toml", "depth_unit = \"m\"", "depth_unit = \"mm\"");
    for name in ["depth_0.png", "depth_1.png"] {
        recorded.write(name, &with_size(grey(4, 4, 255), 9000, 9000));
    }
    assert_unusable(recorded.path(), &["depth_0.png: depth", "cannot hold", "copy or write it"]);
}

/// The size is the camera's, and the data are those of 20 000 such pictures.
#[test]
fn a_png_that_unpacks_to_more_than_its_picture() {
    let recorded = Recorded::two();
    let (width, height) = (CAMERA.width(), CAMERA.height());
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, 20_000 * height);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_compression(png::Compression::Fast);
    let mut writer = encoder.write_header().unwrap();
    let mut rows = writer.stream_writer().unwrap();
    let picture = vec![0; CAMERA.pixel_count()];
    (0..20_000).for_each(|_| rows.write_all(&picture).unwrap());
    rows.finish().unwrap();
    writer.finish().unwrap();
    recorded.write("mask_1.png", &with_size(bytes, width, height));
    assert_unusable(recorded.path(), &["mask_1.png: mask", "Mark the arm"]);
}

/// The PNG with another size in its header, and the checksum that belongs to it.
fn with_size(mut png: Vec<u8>, width: u32, height: u32) -> Vec<u8> {
    // Signature, length and name of the first chunk, then its 13 bytes and their checksum.
    png[16..20].copy_from_slice(&width.to_be_bytes());
    png[20..24].copy_from_slice(&height.to_be_bytes());
    let checksum = crc32fast::hash(&png[12..29]);
    png[29..33].copy_from_slice(&checksum.to_be_bytes());
    png
}
