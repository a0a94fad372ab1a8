//! A small recording in a temporary folder, to be read or broken.

use eyebolt_recording::{Folder, Frame, FrameSource, RecordingError};
use png::{BitDepth, ColorType};
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Size of the camera, pixels.
pub const WIDTH: usize = 4;
/// Size of the camera, pixels.
pub const HEIGHT: usize = 3;
/// Pixels of an image.
pub const PIXELS: usize = WIDTH * HEIGHT;

const MANIFEST: &str = r#"
[camera]
info = "camera_info.yaml"

[frames]
depth = "depth_{}.npy"
depth_unit = "m"
color = "color_{}.png"
mask = "mask_{}.png"
joints = "joints_{}.npy"
joint_names = ["shoulder", "elbow"]

[robot]
urdf = "arm.urdf"
base = "base"
end_effector = "hand"
"#;

const CLOUD_MANIFEST: &str = r#"
[frames]
cloud = "xyz_{}.npy"
cloud_frame = "optical"
depth_unit = "m"
mask = "mask_{}.png"
joints = "joints_{}.npy"
joint_names = ["shoulder", "elbow"]
"#;

pub const CAMERA_INFO: &str = "width: 4
height: 3
distortion_model: plumb_bob
d: [0.0, 0.0, 0.0, 0.0, 0.0]
k: [5.0, 0.0, 1.5, 0.0, 5.0, 1.0, 0.0, 0.0, 1.0]
frame_id: depth_optical
";

/// A recording of the frames 2 and 10.
pub struct Sample {
    folder: TempDir,
}

impl Sample {
    /// Depth in metres, masks, colour, two joints.
    pub fn depth() -> Self {
        let sample = Self::with_manifest(MANIFEST);
        sample.write("camera_info.yaml", CAMERA_INFO.as_bytes());
        for name in ["2", "10"] {
            let depth = vec![1.25_f32; PIXELS];
            sample.write(&format!("depth_{name}.npy"), &npy_f32(&[HEIGHT, WIDTH], &depth));
            let color = png(WIDTH, HEIGHT, ColorType::Rgb, BitDepth::Eight, &[7; 3 * PIXELS]);
            sample.write(&format!("color_{name}.png"), &color);
        }
        sample
    }

    /// Organised clouds in metres and the optical frame, masks, two joints, no camera.
    pub fn cloud() -> Self {
        let sample = Self::with_manifest(CLOUD_MANIFEST);
        for name in ["2", "10"] {
            let points = vec![1.0_f32; 3 * PIXELS];
            sample.write(&format!("xyz_{name}.npy"), &npy_f32(&[HEIGHT, WIDTH, 3], &points));
        }
        sample
    }

    fn with_manifest(text: &str) -> Self {
        let sample = Self { folder: tempfile::tempdir().unwrap() };
        sample.write("recording.toml", text.as_bytes());
        for name in ["2", "10"] {
            sample.write(&format!("joints_{name}.npy"), &npy_f64(&[2], &[0.5, -1.5]));
            let mut mask = vec![0; PIXELS];
            mask[5] = 255;
            let mask = png(WIDTH, HEIGHT, ColorType::Grayscale, BitDepth::Eight, &mask);
            sample.write(&format!("mask_{name}.png"), &mask);
        }
        sample
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    pub fn file(&self, name: &str) -> PathBuf {
        self.path().join(name)
    }

    pub fn write(&self, name: &str, bytes: &[u8]) {
        fs::write(self.file(name), bytes).unwrap();
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.file(name)).unwrap()
    }

    pub fn remove(&self, name: &str) {
        fs::remove_file(self.file(name)).unwrap();
    }

    /// Replaces text that must be there in a text file.
    pub fn edit(&self, name: &str, from: &str, to: &str) {
        let text = String::from_utf8(self.read(name)).unwrap();
        assert!(text.contains(from), "{name} lacks {from}");
        self.write(name, text.replace(from, to).as_bytes());
    }

    /// Replaces text in `recording.toml`.
    pub fn describe(&self, from: &str, to: &str) {
        self.edit("recording.toml", from, to);
    }

    pub fn open(&self) -> Result<Folder, RecordingError> {
        Folder::open(self.path())
    }

    /// The first frame.
    pub fn frame(&self) -> Result<Frame, RecordingError> {
        self.open()?.read_frame(0)
    }
}

/// An NPY file of version 1.
pub fn npy(descr: &str, fortran: bool, shape: &[usize], data: &[u8]) -> Vec<u8> {
    let axes: String = shape.iter().map(|axis| format!("{axis}, ")).collect();
    let order = if fortran { "True" } else { "False" };
    let header = format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': ({axes}), }}");
    npy_with_header(&header, data)
}

/// An NPY file of version 1 with any header.
pub fn npy_with_header(header: &str, data: &[u8]) -> Vec<u8> {
    let mut header = header.to_owned();
    while !(10 + header.len() + 1).is_multiple_of(64) {
        header.push(' ');
    }
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(u16::try_from(header.len()).unwrap().to_le_bytes());
    bytes.extend(header.bytes());
    bytes.extend(data);
    bytes
}

pub fn npy_f32(shape: &[usize], values: &[f32]) -> Vec<u8> {
    npy("<f4", false, shape, &values.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<_>>())
}

pub fn npy_f64(shape: &[usize], values: &[f64]) -> Vec<u8> {
    npy("<f8", false, shape, &values.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<_>>())
}

pub fn npy_u16(shape: &[usize], values: &[u16]) -> Vec<u8> {
    npy("<u2", false, shape, &values.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<_>>())
}

pub fn png(w: usize, h: usize, color: ColorType, depth: BitDepth, data: &[u8]) -> Vec<u8> {
    png_with_palette(w, h, color, depth, data, None)
}

/// A PNG; `palette` holds RGB triples.
pub fn png_with_palette(
    width: usize,
    height: usize,
    color: ColorType,
    depth: BitDepth,
    data: &[u8],
    palette: Option<&[u8]>,
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let size = |pixels: usize| u32::try_from(pixels).unwrap();
    let mut encoder = png::Encoder::new(&mut bytes, size(width), size(height));
    encoder.set_color(color);
    encoder.set_depth(depth);
    if let Some(palette) = palette {
        encoder.set_palette(palette.to_vec());
    }
    encoder.write_header().unwrap().write_image_data(data).unwrap();
    bytes
}

pub fn png_u16(width: usize, height: usize, values: &[u16]) -> Vec<u8> {
    let data: Vec<_> = values.iter().flat_map(|v| v.to_be_bytes()).collect();
    png(width, height, ColorType::Grayscale, BitDepth::Sixteen, &data)
}

/// Checks that the text of the error has all `parts`.
#[track_caller]
pub fn assert_says<T>(result: Result<T, RecordingError>, parts: &[&str]) {
    let Err(error) = result else { panic!("no error, expected one with {parts:?}") };
    let text = error.to_string();
    for part in parts {
        assert!(text.contains(part), "no {part:?} in: {text}");
    }
}
