//! Depth that cannot be meant.

use crate::folder::{Recorded, SHOTS};
use crate::outcome::assert_unusable;
use crate::recording::npy_f32;
use crate::scene::CAMERA;

/// The shape of depth images.
pub fn shape() -> [usize; 2] {
    [CAMERA.height() as usize, CAMERA.width() as usize]
}

#[test]
fn millimetres_said_to_be_metres() {
    let recorded = Recorded::two();
    let millimetres: Vec<f32> = SHOTS[1].depth_m.iter().map(|z| 1e3 * z).collect();
    recorded.write("depth_1.npy", &npy_f32(&shape(), &millimetres));
    let words = ["depth_1.npy: depth", "looks like millimetres", "Set depth_unit = \"mm\""];
    assert_unusable(recorded.path(), &words);
}

#[test]
fn metres_said_to_be_millimetres() {
    let recorded = Recorded::two();
    recorded.replace("recording.toml", "depth_unit = \"m\"", "depth_unit = \"mm\"");
    let words = ["depth_0.npy: depth", "looks like metres", "Set depth_unit = \"m\""];
    assert_unusable(recorded.path(), &words);
}

#[test]
fn a_frame_without_any_depth() {
    for nothing in [f32::NAN, 0.0] {
        let recorded = Recorded::two();
        recorded.write("depth_1.npy", &npy_f32(&shape(), &vec![nothing; CAMERA.pixel_count()]));
        let words = ["depth_1.npy: depth", "no pixel has depth", "Leave this frame out"];
        assert_unusable(recorded.path(), &words);
    }
}
