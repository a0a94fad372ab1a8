//! Meshes in STL, OBJ, DAE and glTF.
#![no_main]

use eyebolt_fuzz::file;
use eyebolt_geometry::Transform;
use eyebolt_robot::{Body, Shape, load_body};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    for name in ["mesh.stl", "mesh.obj", "mesh.dae", "mesh.glb", "mesh.gltf"] {
        let path = file(name, bytes);
        let shape = Shape::Mesh { path, scale: [1.0, -2.0, 1e-3] };
        let Ok(mesh) = load_body(&Body { link_from_body: Transform::identity(), shape }) else {
            continue;
        };
        assert!(!mesh.triangles.is_empty());
        assert!(mesh.vertices.iter().flat_map(|vertex| vertex.iter()).all(|v| v.is_finite()));
        let corners = mesh.triangles.iter().flatten();
        assert!(corners.clone().all(|corner| (*corner as usize) < mesh.vertices.len()));
    }
});
