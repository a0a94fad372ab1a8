//! glTF and GLB: the same mesh as the plain shape that it is made of.
#![allow(clippy::unwrap_used)]

use eyebolt_geometry::Transform;
use eyebolt_robot::{Body, MeshError, Shape, TriangleMesh, body_fingerprint, load_body};
use proptest::prelude::*;
use std::path::Path;

/// A tetrahedron: four positions (48 bytes), twelve indices of one byte.
const POSITIONS: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const INDICES: [u8; 12] = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3];

fn buffer() -> Vec<u8> {
    let positions = POSITIONS.iter().flatten().flat_map(|x| x.to_le_bytes());
    positions.chain(INDICES).collect()
}

fn document(buffer: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"children":[1],"translation":[0,0,5]}},{{"mesh":0,"scale":[-2,2,2]}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}},
        {{"bufferView":1,"componentType":5121,"count":12,"type":"SCALAR"}}],
        "bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":12}}],
        "buffers":[{{"byteLength":60{buffer}}}]}}"#
    )
}

fn glb() -> Vec<u8> {
    let mut json = document("").into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let binary = buffer();
    let length = 12 + 8 + json.len() + 8 + binary.len();
    let mut bytes = b"glTF".to_vec();
    for number in [2, length] {
        bytes.extend((number as u32).to_le_bytes());
    }
    for (kind, chunk) in [(b"JSON", &json), (b"BIN\0", &binary)] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}

fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let digit = |number: u32, place: u32| char::from(DIGITS[(number >> (6 * place)) as usize & 63]);
    let group = |three: &[u8]| {
        let number = three.iter().fold(0, |number, byte| (number << 8) | u32::from(*byte));
        [3, 2, 1, 0].map(|place| digit(number, place))
    };
    assert_eq!(bytes.len() % 3, 0);
    bytes.chunks(3).flat_map(group).collect()
}

fn body(path: &Path) -> Body {
    let shape = Shape::Mesh { path: path.to_owned(), scale: [1.0; 3] };
    Body { link_from_body: Transform::identity(), shape }
}

fn load(path: &Path) -> Result<TriangleMesh, MeshError> {
    load_body(&body(path))
}

fn volume(mesh: &TriangleMesh) -> f64 {
    let at = |i: u32| mesh.vertices[i as usize].coords.cast::<f64>();
    let signed = |[a, b, c]: &[u32; 3]| at(*a).dot(&at(*b).cross(&at(*c))) / 6.0;
    mesh.triangles.iter().map(signed).sum()
}

#[test]
fn every_form_gives_the_same_mesh() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let data = format!(r#","uri":"data:application/octet-stream;base64,{}""#, base64(&buffer()));
    std::fs::write(path("a.glb"), glb()).unwrap();
    std::fs::write(path("b.gltf"), document(&data)).unwrap();
    std::fs::write(path("c.gltf"), document(r#","uri":"c%20d.bin""#)).unwrap();
    std::fs::write(path("c d.bin"), buffer()).unwrap();
    for name in ["a.glb", "b.gltf", "c.gltf"] {
        let mesh = load(&path(name)).unwrap();
        assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (4, 4), "{name}");
        // Mirrored, eight times as large, and its faces still outward.
        assert!((volume(&mesh) - 8.0 / 6.0).abs() < 1e-6, "{name}");
        let (low, high) = mesh.bounds().unwrap();
        assert_eq!((low.x, high.x, low.z, high.z), (-2.0, 0.0, 5.0, 7.0), "{name}");
    }
    // What lies beside a file is part of what the cache knows it by.
    let before = body_fingerprint(&body(&path("c.gltf"))).unwrap();
    let mut changed = buffer();
    changed[0] ^= 1;
    std::fs::write(path("c d.bin"), changed).unwrap();
    assert_ne!(before, body_fingerprint(&body(&path("c.gltf"))).unwrap());
}

#[test]
fn what_is_wrong_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |name: &str, content: Vec<u8>, word: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, content).unwrap();
        let error = load(&path).unwrap_err().to_string();
        assert!(error.contains(name) && error.contains(word), "`{word}` is not in: {error}");
    };
    let with = |from: &str, to: &str| {
        let whole = document(&format!(r#","uri":"data:a;base64,{}""#, base64(&buffer())));
        assert!(whole.contains(from), "{from}");
        whole.replace(from, to).into_bytes()
    };
    refused("a.gltf", b"{".to_vec(), "glTF");
    refused("a.glb", b"glTF".to_vec(), "announced");
    refused("a.glb", [&b"glTF\x02\0\0\0\x03\0\0\0"[..], &[0; 8]].concat(), "3 bytes are announced");
    refused("a.gltf", with(r#""count":4"#, r#""count":5"#), "5 are announced");
    refused("a.gltf", with("5126", "5123"), "POSITION");
    refused("a.gltf", with(r#""mesh":0"#, r#""children":[0]"#), "contain themselves");
    refused(
        "a.gltf",
        document(r#","uri":"../secret.bin""#).into_bytes(),
        "below this one's folder",
    );
    refused("a.gltf", document(r#","uri":"/etc/hosts""#).into_bytes(), "below this one's folder");
    let path = folder.path().join("a.gltf");
    std::fs::write(&path, document(r#","uri":"missing.bin""#)).unwrap();
    let error = load(&path).unwrap_err().to_string();
    assert!(error.contains("missing.bin") && error.contains("check the path"), "{error}");
}

proptest! {
    /// Any damage gives a mesh or an error, never a panic.
    #[test]
    fn damage_never_panics(
        embedded: bool,
        cut in 0..1500_usize,
        changes in prop::collection::vec((0..1500_usize, any::<u8>()), 0..4),
    ) {
        let data = format!(r#","uri":"data:a;base64,{}""#, base64(&buffer()));
        let mut bytes = if embedded { document(&data).into_bytes() } else { glb() };
        for (place, byte) in changes {
            let place = place % bytes.len();
            bytes[place] = byte;
        }
        bytes.truncate(cut.max(bytes.len() / 2));
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(if embedded { "a.gltf" } else { "a.glb" });
        std::fs::write(&path, bytes).unwrap();
        if let Ok(mesh) = load(&path) {
            prop_assert!(mesh.vertices.iter().all(|v| v.iter().all(|x| x.is_finite())));
        }
    }
}
