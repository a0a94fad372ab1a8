//! Agreement with Embree, whose depth images are stored beside the mesh (see `ray_bench.py`).

use eyebolt_geometry::{Base, Camera, Distortion, PinholeCamera, RayTable, Transform};
use eyebolt_render::{RayScene, SceneMesh};
use eyebolt_robot::{Body, Shape, load_body};
use nalgebra::Matrix4;
use std::io::Write;
use std::path::{Path, PathBuf};

fn inputs() -> Option<PathBuf> {
    let Some(root) = std::env::var_os("EYEBOLT_SHARED") else {
        // Straight to the terminal: the test harness hides what passing tests print.
        let text =
            "SKIPPED agreement with Embree: set EYEBOLT_SHARED to the folder with bench/inputs";
        let _ = writeln!(std::io::stderr(), "{text}");
        return None;
    };
    Some(PathBuf::from(root).join("bench/inputs"))
}

/// The data of an NPY file, without its header.
fn npy(path: &Path) -> Vec<u8> {
    let bytes = std::fs::read(path).unwrap();
    let end = bytes.iter().position(|byte| *byte == b'\n').unwrap();
    bytes[end + 1..].to_vec()
}

fn doubles(path: &Path) -> Vec<f64> {
    npy(path).chunks_exact(8).map(|c| f64::from_le_bytes(c.try_into().unwrap())).collect()
}

#[test]
fn depth_is_that_of_embree() {
    let Some(inputs) = inputs() else { return };
    let shape = Shape::Mesh { path: inputs.join("ray_mesh.stl"), scale: [1.0; 3] };
    let mesh = load_body(&Body { link_from_body: Transform::identity(), shape }).unwrap();
    let scene = RayScene::new(&[SceneMesh { mesh: &mesh, base_from_mesh: Transform::identity() }]);
    let k = doubles(&inputs.join("ray_K.npy"));
    let camera = PinholeCamera::new(640, 480, k[0], k[4], k[2], k[5], Distortion::None).unwrap();
    for view in ["", "_near"] {
        let pose = doubles(&inputs.join(format!("ray_extrinsic_world_to_cam{view}.npy")));
        let pose = Matrix4::from_row_slice(&pose);
        let camera_from_base: Transform<Camera, Base> =
            Transform::from_matrix(&pose, 1e-6).unwrap();
        let mut ours = Vec::new();
        scene.depth(&RayTable::new(&camera), &camera_from_base.inverse(), &mut ours);
        let theirs = npy(&inputs.join(format!("ray_depth_open3d{view}.npy")));
        let theirs = theirs.chunks_exact(4).map(|c| f32::from_le_bytes(c.try_into().unwrap()));
        assert_eq!(theirs.len(), ours.len());
        for (at, (ours, theirs)) in ours.iter().zip(theirs).enumerate() {
            assert_eq!(*ours > 0.0, theirs > 0.0, "only one hits at {at}{view}");
            assert!((ours - theirs).abs() < 1e-5, "{ours} {theirs} at {at}{view}");
        }
    }
}
