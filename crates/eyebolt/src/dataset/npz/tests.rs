//! There and back, and files that are not whole.

use super::{Archive, Array, npz};
use eyebolt_recording::Dtype;
use std::path::Path;

fn sample() -> Vec<u8> {
    npz(&[
        Array::float32("depth_m", &[2, 3], [0.5, 1.0, 1.5, 2.0, 2.5, 3.0]),
        Array::uint8("label", &[2, 3], [0, 1, 2, 255, 0, 1]),
        Array::float64("pose", &[1], [std::f64::consts::PI]),
    ])
}

#[test]
fn arrays_come_back_as_they_were() {
    let bytes = sample();
    let archive = Archive::open(Path::new("a.npz"), &bytes).unwrap();
    let (shape, depth) = archive.array::<f32>("depth_m", &[Dtype::Float32]).unwrap();
    assert_eq!((shape, depth), (vec![2, 3], vec![0.5, 1.0, 1.5, 2.0, 2.5, 3.0]));
    let (_, label) = archive.array::<f32>("label", &[Dtype::Uint8]).unwrap();
    assert_eq!(label, [0.0, 1.0, 2.0, 255.0, 0.0, 1.0]);
    let (_, pose) = archive.array::<f64>("pose", &[Dtype::Float64]).unwrap();
    assert_eq!(pose, [std::f64::consts::PI]);
    let error = archive.array::<f32>("colour", &[Dtype::Uint8]).unwrap_err().to_string();
    assert!(error.contains("a.npz: colour") && error.contains("depth_m, label, pose"), "{error}");
}

#[test]
fn no_cut_passes_and_none_panics() {
    let bytes = sample();
    for length in 0..bytes.len() {
        assert!(Archive::open(Path::new("a.npz"), &bytes[..length]).is_err(), "{length}");
    }
}

#[test]
fn no_flipped_number_passes() {
    let bytes = sample();
    let mut passed = 0;
    for at in 0..bytes.len() {
        let mut flipped = bytes.clone();
        flipped[at] ^= 0x10;
        let path = Path::new("a.npz");
        let read = Archive::open(path, &flipped).and_then(|archive| {
            let depth = archive.array::<f32>("depth_m", &[Dtype::Float32])?;
            Ok((depth, archive.array::<f32>("label", &[Dtype::Uint8])?))
        });
        let Ok((depth, label)) = read else { continue };
        // Times, versions and attributes mean nothing to arrays.
        assert_eq!(depth.1, [0.5, 1.0, 1.5, 2.0, 2.5, 3.0]);
        assert_eq!(label.1, [0.0, 1.0, 2.0, 255.0, 0.0, 1.0]);
        passed += 1;
    }
    assert!(passed < bytes.len() / 2, "{passed}");
}
