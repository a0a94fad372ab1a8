//! What is wrong with a mesh is said with the file, the field and the remedy.
#![allow(clippy::unwrap_used)]

mod common;

use eyebolt_geometry::Transform;
use eyebolt_robot::{Body, MAX_MESH_BYTES, MAX_TRIANGLES, Shape, body_fingerprint, load_body};
use proptest::prelude::*;
use std::path::Path;

fn load(path: &Path) -> Result<eyebolt_robot::TriangleMesh, eyebolt_robot::MeshError> {
    let shape = Shape::Mesh { path: path.to_owned(), scale: [1.0; 3] };
    load_body(&Body { link_from_body: Transform::identity(), shape })
}

/// The file is refused and the message names it and has all the words.
#[track_caller]
fn refused(name: &str, content: impl AsRef<[u8]>, words: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, content).unwrap();
    let text = load(&path).unwrap_err().to_string();
    for word in [&[name], words].concat() {
        assert!(text.contains(word), "`{word}` is not in: {text}");
    }
}

const AGAIN: &str = "export the mesh again";

fn binary_stl(announced: u32, triangles: &[[f32; 9]]) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend(announced.to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flat_map(|number| number.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

const RIGHT: [f32; 9] = [0., 0., 0., 1., 0., 0., 0., 1., 0.];

#[test]
fn files() {
    let folder = tempfile::tempdir().unwrap();
    let text = load(&folder.path().join("none.stl")).unwrap_err().to_string();
    assert!(text.contains("none.stl: cannot read") && text.contains("check the path"), "{text}");
    refused("a.fbx", "", &["type `fbx`", "STL, OBJ, DAE or GLB"]);
    let path = folder.path().join("large.stl");
    std::fs::File::create(&path).unwrap().set_len(MAX_MESH_BYTES + 1).unwrap();
    let text = load(&path).unwrap_err().to_string();
    assert!(text.contains("large.stl") && text.contains("decimate"), "{text}");
    let shape = Shape::Mesh { path, scale: [1.0; 3] };
    assert!(body_fingerprint(&Body { link_from_body: Transform::identity(), shape }).is_err());
}

#[test]
fn stl() {
    refused("a.stl", "", &["header", "84", AGAIN]);
    let whole = binary_stl(2, &[RIGHT, RIGHT]);
    refused("a.stl", &whole[..whole.len() - 1], &["triangle count", "2 triangles", "184", AGAIN]);
    refused("a.stl", binary_stl(u32::MAX, &[RIGHT]), &["4294967295 triangles", AGAIN]);
    refused("a.stl", binary_stl(1, &[RIGHT, RIGHT]), &["1 triangles in 134 bytes", "184"]);
    let mut nan = RIGHT;
    nan[4] = f32::NAN;
    refused("a.stl", binary_stl(1, &[nan]), &["triangle 0", "vertex 1", "not finite", AGAIN]);
    refused("a.stl", binary_stl(0, &[]), &["no triangles", AGAIN]);
    refused("a.stl", binary_stl(1, &[[1.0; 9]]), &["no triangles"]);
    refused("a.stl", "solid\nfacet\nvertex 0 0\n", &["line 3", "`vertex 0 0`"]);
    refused("a.stl", "solid\nfacet\nvertex 0 0 0\nendfacet\n", &["line 4", "1 vertices"]);
    refused("a.stl", "solid\nfacet\nvertex 0 0 0\n", &["cut off"]);
}

#[test]
fn too_many_triangles() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("many.stl");
    let count = u32::try_from(MAX_TRIANGLES).unwrap() + 1;
    std::fs::write(&path, binary_stl(count, &[])).unwrap();
    let file = std::fs::OpenOptions::new().write(true).open(&path).unwrap();
    file.set_len(84 + 50 * u64::from(count)).unwrap();
    let text = load(&path).unwrap_err().to_string();
    assert!(text.contains("many.stl") && text.contains("collision mesh"), "{text}");
    let shape = Shape::Sphere { radius: 1e6 };
    let text = load_body(&Body { link_from_body: Transform::identity(), shape }).unwrap_err();
    assert!(text.to_string().starts_with("sphere: more than 5000000 triangles"), "{text}");
}

#[test]
fn obj() {
    let v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    refused("a.obj", format!("{v}f 1 2 4\n"), &["line 4", "vertex 4 (from 1)", "3 so far", AGAIN]);
    refused("a.obj", format!("{v}f 1 2 0\n"), &["line 4", "vertex 0 (from 1)"]);
    refused("a.obj", format!("{v}f 1 2 -4\n"), &["vertex -4 (from 1)"]);
    refused("a.obj", format!("{v}f 1 2 {}\n", i64::MIN), &["(from 1)"]);
    refused("a.obj", format!("{v}f 1 2 x\n"), &["`x` is not a corner"]);
    refused("a.obj", format!("{v}f 1 2\n"), &["fewer than 3 corners"]);
    refused("a.obj", "v 0 nan 0\n", &["line 1", "not finite"]);
    refused("a.obj", "v 0 0\n", &["line 1", "not a coordinate"]);
    refused("a.obj", "\u{0}\u{1}", &["no triangles"]);
}

fn dae(mesh: &str, scene: &str) -> String {
    format!(
        r##"<COLLADA><library_geometries><geometry id="g"><mesh>
        <source id="s"><float_array id="a">0 0 0 1 0 0 0 1 0</float_array>
        <technique_common><accessor source="#a" count="3" stride="3"/></technique_common></source>
        <vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
        {mesh}</mesh></geometry></library_geometries>
        <library_visual_scenes><visual_scene id="w">{scene}</visual_scene></library_visual_scenes>
        <scene><instance_visual_scene url="#w"/></scene></COLLADA>"##
    )
}

const SHOWN: &str = r##"<node><instance_geometry url="#g"/></node>"##;

#[test]
fn dae_files() {
    let triangles = |count: &str, p: &str| {
        format!(
            r##"<triangles count="{count}"><input semantic="VERTEX" source="#v" offset="0"/><p>{p}</p></triangles>"##
        )
    };
    let good = triangles("1", "0 1 2");
    refused("a.dae", "", &["XML", AGAIN]);
    refused("a.dae", [0xff, 0xfe], &["UTF-8"]);
    refused("a.dae", "<!DOCTYPE a><COLLADA/>", &["remove the DOCTYPE"]);
    refused("a.dae", "<COLLADA/>", &["no <visual_scene>"]);
    refused("a.dae", dae(&good, ""), &["no triangles"]);
    let with = |mesh: &str| dae(mesh, SHOWN);
    refused("a.dae", with(&triangles("1", "0 1 3")), &["geometry `g`", "index 3", "3 positions"]);
    refused("a.dae", with(&triangles("1", "0 1 -1")), &["`-1` is not an index"]);
    refused("a.dae", with(&triangles("1", "0 1")), &["threes"]);
    refused("a.dae", with(&good.replace("#v", "#x")), &["nothing has the id `#x`"]);
    refused("a.dae", with(&good).replace("0 1 0<", "0 1<"), &["position 2", "cut off"]);
    refused("a.dae", with(&good).replace("0 1 0<", "0 nan 0<"), &["`nan`", "finite"]);
    refused("a.dae", with(&good).replace(r#"stride="3""#, r#"stride="0""#), &["stride 0"]);
    let unit = r#"<COLLADA><asset><unit meter="0"/></asset>"#;
    refused("a.dae", with(&good).replace("<COLLADA>", unit), &["meter", "`0` is not a length"]);
    let scene = |part: &str| dae(&good, &format!("<node>{part}</node>"));
    refused("a.dae", scene("<matrix>1 0 0</matrix>"), &["matrix: not 16"]);
    refused("a.dae", scene("<skew>1</skew>"), &["skew", "bake"]);
    refused("a.dae", scene(r##"<instance_controller url="#c"/>"##), &["skinned"]);
    refused("a.dae", scene(r##"<instance_geometry url="#h"/>"##), &["`#h`"]);
    let loops = r##"<node id="n"><instance_node url="#n"/></node>"##;
    refused("a.dae", dae(&good, loops), &["nested too deep or show themselves"]);
}

/// Exporters count floats where positions belong, or nothing at all: what is there counts.
#[test]
fn the_data_count_and_not_the_announcement() {
    let folder = tempfile::tempdir().unwrap();
    let triangles = |name: &str, content: Vec<u8>| {
        let path = folder.path().join(name);
        std::fs::write(&path, content).unwrap();
        load(&path).unwrap().triangles.len()
    };
    let part = r##"<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>"##;
    for (announced, found) in [
        (r#"count="3" stride"#, r#"count="9" stride"#),
        (r#"count="3" stride"#, r#"count="1" stride"#),
        (r#"count="3" stride"#, r#"count="18446744073709551615" stride"#),
        (r#"count="3" stride"#, "stride"),
        (r#"<triangles count="1""#, r#"<triangles count="2""#),
    ] {
        let text = dae(part, SHOWN);
        assert!(text.contains(announced));
        assert_eq!(triangles("a.dae", text.replace(announced, found).into_bytes()), 1, "{found}");
    }
}

proptest! {
    /// Any damage to a file gives a mesh or an error, never a panic; meshes are always whole.
    #[test]
    fn damage_never_panics(
        which in 0..4_usize,
        cut in 0..2000_usize,
        changes in prop::collection::vec((0..2000_usize, any::<u8>()), 0..4),
    ) {
        let triangles = r##"<triangles><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>"##;
        let (name, mut bytes) = match which {
            0 => ("a.stl", binary_stl(2, &[RIGHT, RIGHT])),
            1 => ("a.stl", b"solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet".to_vec()),
            2 => ("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf -1//1 -2 -3 1\n".to_vec()),
            _ => ("a.dae", dae(triangles, SHOWN).into_bytes()),
        };
        for (place, byte) in changes {
            let place = place % bytes.len();
            bytes[place] = byte;
        }
        bytes.truncate(cut.max(bytes.len() / 2));
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        if let Ok(mesh) = load(&path) {
            prop_assert!(!mesh.triangles.is_empty());
            prop_assert!(mesh.vertices.iter().all(|v| v.iter().all(|x| x.is_finite())));
            let count = mesh.vertices.len();
            prop_assert!(mesh.triangles.iter().flatten().all(|i| (*i as usize) < count));
        }
    }
}
