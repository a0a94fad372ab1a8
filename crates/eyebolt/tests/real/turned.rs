//! The recording seen by a camera turned by a known rotation: clouds whose points are rotated, with
//! no camera given.

use crate::recording::{FRAMES, Variant, shared, trusted};
use eyebolt_geometry::{Camera, Transform};
use eyebolt_recording::Range;
use eyebolt_registration::spread_rotations;
use nalgebra::{Point3, UnitQuaternion, Vector3};
use std::path::Path;

/// NPY file of `height x width x 3` float32.
fn write_cloud(path: &Path, width: usize, height: usize, points: &[Point3<f32>]) {
    let header =
        format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({height}, {width}, 3), }}");
    let padded = format!("{header:<117}\n");
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((padded.len() as u16).to_le_bytes());
    bytes.extend(padded.as_bytes());
    bytes.extend(points.iter().flat_map(|p| p.coords.data.0[0]).flat_map(f32::to_le_bytes));
    std::fs::write(path, bytes).unwrap();
}

fn write_turned(variant: &Variant, shared: &Path, turn: &UnitQuaternion<f64>) -> tempfile::TempDir {
    let source = variant.open(shared);
    let folder = tempfile::tempdir().unwrap();
    let data = shared.join("data/recordings/lbr_med7_zed2i");
    for frame in FRAMES {
        let Range::Depth(depth) = source.recording.read_frame(frame).unwrap().range else {
            panic!("the recording has depth images")
        };
        let cloud = depth.unproject(source.recording.camera().unwrap()).unwrap().rotated(turn);
        let path = folder.path().join(format!("xyz_{frame}.npy"));
        write_cloud(&path, depth.width() as usize, depth.height() as usize, cloud.points());
        for (from, to) in [
            (format!("joint_states_{frame}.npy"), format!("joint_states_{frame}.npy")),
            (format!("mask_sam2_left_image_{frame}.png"), format!("mask_{frame}.png")),
        ] {
            std::fs::copy(data.join(from), folder.path().join(to)).unwrap();
        }
    }
    let frames = "cloud = \"xyz_{}.npy\"\ncloud_frame = \"optical\"\ndepth_unit = \"m\"\n\
                  mask = \"mask_{}.png\"\n";
    std::fs::write(folder.path().join("recording.toml"), variant.manifest("", frames)).unwrap();
    folder
}

#[test]
fn a_turned_camera_gives_the_turned_answer() {
    let Some(shared) = shared() else { return };
    let variant = Variant::default();
    let upright = trusted(&variant.open(&shared).run());
    for turn in spread_rotations(30, 7) {
        let folder = write_turned(&variant, &shared, &turn);
        let outcome = variant.opened(&shared, folder).run();
        let turned_from_camera = Transform::<Camera, Camera>::from_parts(Vector3::zeros(), turn);
        let (metres, radians) = trusted(&outcome).distance_to(&(turned_from_camera * upright));
        let (mm, degrees) = (1e3 * metres, radians.to_degrees());
        assert!(mm <= 1.0 && degrees <= 0.05, "{mm} mm, {degrees} degrees");
    }
}
