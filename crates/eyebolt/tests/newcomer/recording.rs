//! Shots into a recording folder.

use crate::scene::{CAMERA, JOINT_NAMES, Shot, URDF};
use std::fmt::Write;
use std::path::Path;

/// Writes `shots` to `folder` as depth images with masks, with a camera and the robot.
pub fn write_depth(folder: &Path, shots: &[Shot]) {
    let camera = &*CAMERA;
    let (width, height) = (camera.width(), camera.height());
    let [fx, fy, cx, cy] = [camera.fx(), camera.fy(), camera.cx(), camera.cy()];
    let info = format!(
        "header:\n  frame_id: depth_optical\nwidth: {width}\nheight: {height}\n\
         distortion_model: plumb_bob\nd: [0.0, 0.0, 0.0, 0.0, 0.0]\n\
         k: [{fx:?}, 0.0, {cx:?}, 0.0, {fy:?}, {cy:?}, 0.0, 0.0, 1.0]\n"
    );
    write(folder, "camera_info.yaml", info.as_bytes());
    for (frame, shot) in shots.iter().enumerate() {
        let depth = npy_f32(&[height as usize, width as usize], &shot.depth_m);
        write(folder, &format!("depth_{frame}.npy"), &depth);
    }
    write_masks(folder, shots);
    let range = "depth = \"depth_{}.npy\"\nmask = \"mask_{}.png\"";
    write_rest(folder, shots, "[camera]\ninfo = \"camera_info.yaml\"", range);
}

/// Writes a PNG for the mask of each shot.
pub fn write_masks(folder: &Path, shots: &[Shot]) {
    for (frame, shot) in shots.iter().enumerate() {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, CAMERA.width(), CAMERA.height());
        encoder.set_color(png::ColorType::Grayscale);
        let grey: Vec<u8> = shot.mask.iter().map(|set| 255 * u8::from(*set)).collect();
        encoder.write_header().unwrap().write_image_data(&grey).unwrap();
        write(folder, &format!("mask_{frame}.png"), &bytes);
    }
}

/// Writes joints, the robot and the description; `camera` is its `[camera]` section, `range` the
/// keys of `[frames]` that say where depth or clouds are.
pub fn write_rest(folder: &Path, shots: &[Shot], camera: &str, range: &str) {
    for (frame, shot) in shots.iter().enumerate() {
        write(folder, &format!("joints_{frame}.npy"), &npy_f64(&[6], &shot.joints));
    }
    write(folder, "arm.urdf", URDF.as_bytes());
    let mut text = format!("{camera}\n\n[frames]\n{range}\ndepth_unit = \"m\"\n");
    let _ = writeln!(text, "joints = \"joints_{{}}.npy\"\njoint_names = {JOINT_NAMES:?}");
    text.push_str("\n[robot]\nurdf = \"arm.urdf\"\nbase = \"base\"\nend_effector = \"hand\"\n");
    write(folder, "recording.toml", text.as_bytes());
}

pub fn write(folder: &Path, name: &str, bytes: &[u8]) {
    std::fs::write(folder.join(name), bytes).unwrap();
}

pub fn npy_f32(shape: &[usize], values: &[f32]) -> Vec<u8> {
    npy("<f4", shape, values.iter().flat_map(|value| value.to_le_bytes()).collect())
}

pub fn npy_f64(shape: &[usize], values: &[f64]) -> Vec<u8> {
    npy("<f8", shape, values.iter().flat_map(|value| value.to_le_bytes()).collect())
}

/// A file of version 1.0 of NumPy's format.
fn npy(descr: &str, shape: &[usize], data: Vec<u8>) -> Vec<u8> {
    let axes: String = shape.iter().map(|axis| format!("{axis}, ")).collect();
    let header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({axes}), }}");
    // Six bytes of magic, two of version, two of length, and a line break at the end.
    let length = (10 + header.len() + 1).next_multiple_of(64) - 10;
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(u16::try_from(length).unwrap().to_le_bytes());
    bytes.extend(format!("{header:<width$}\n", width = length - 1).bytes());
    bytes.extend(data);
    bytes
}
