//! Meshes: trimesh's sizes of real files, exact small files, and shapes with known areas.
#![allow(clippy::unwrap_used)]

mod common;

use eyebolt_geometry::Transform;
use eyebolt_robot::{
    Body, Prefer, Shape, TriangleMesh, body_fingerprint, link_fingerprint, link_mesh, load_body,
};
use nalgebra::{UnitQuaternion, Vector3};
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::path::Path;

fn body(shape: Shape) -> Body {
    Body { link_from_body: Transform::identity(), shape }
}

fn file(path: &Path) -> Body {
    body(Shape::Mesh { path: path.to_owned(), scale: [1.0; 3] })
}

fn written(name: &str, content: impl AsRef<[u8]>) -> TriangleMesh {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, content).unwrap();
    load_body(&file(&path)).unwrap()
}

fn corners(mesh: &TriangleMesh) -> impl Iterator<Item = [Vector3<f64>; 3]> {
    let at = |i: u32| mesh.vertices[i as usize].coords.cast::<f64>();
    mesh.triangles.iter().map(move |triangle| triangle.map(at))
}

fn area(mesh: &TriangleMesh) -> f64 {
    corners(mesh).map(|[a, b, c]| (b - a).cross(&(c - a)).norm() / 2.0).sum()
}

/// Positive where triangles run counter-clockwise as seen from outside.
fn volume(mesh: &TriangleMesh) -> f64 {
    corners(mesh).map(|[a, b, c]| a.dot(&b.cross(&c)) / 6.0).sum()
}

/// Every edge has a triangle on both sides, which run along it in opposite directions.
fn is_closed(mesh: &TriangleMesh) -> bool {
    let mut edges = BTreeMap::<(u32, u32), i32>::new();
    for [a, b, c] in &mesh.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *edges.entry((*from.min(to), *from.max(to))).or_default() +=
                if from < to { 1 } else { -1 };
        }
    }
    edges.values().all(|balance| *balance == 0)
}

#[derive(serde::Deserialize)]
struct Size {
    low: [f32; 3],
    high: [f32; 3],
    area: f64,
}

/// Made by fixtures/make_meshes.py. Bounds to 1 µm, areas to 1e-5 of themselves.
#[test]
fn sizes_as_trimesh() {
    let text = std::fs::read_to_string(common::fixture("meshes.json")).unwrap();
    let sizes: BTreeMap<String, Size> = serde_json::from_str(&text).unwrap();
    assert_eq!(sizes.len(), 35);
    for (path, size) in sizes {
        let Some(full) = common::shared(&path) else { return };
        let mesh = load_body(&file(&full)).unwrap();
        let (low, high) = mesh.bounds().unwrap();
        for axis in 0..3 {
            assert!((low[axis] - size.low[axis]).abs() < 1e-6, "{path}: {low}");
            assert!((high[axis] - size.high[axis]).abs() < 1e-6, "{path}: {high}");
        }
        let found = area(&mesh);
        assert!((found - size.area).abs() < 1e-5 * size.area, "{path}: {found} m2, {}", size.area);
    }
}

/// What a link looks like and its collision body cover the same box: hulls of some, hence 6 mm.
#[test]
fn visual_and_collision_meshes_agree() {
    for robot in [common::panda(), common::lbr()].into_iter().flatten() {
        let both = robot.links.iter().filter(|l| !l.visuals.is_empty() && !l.collisions.is_empty());
        for link in both {
            let visual = link_mesh(link, Prefer::Visual).unwrap().unwrap().bounds().unwrap();
            let collision = link_mesh(link, Prefer::Collision).unwrap().unwrap().bounds().unwrap();
            let apart = (visual.0 - collision.0).amax().max((visual.1 - collision.1).amax());
            assert!(apart < 0.006, "{}: {apart} m", link.name);
        }
    }
}

const TETRAHEDRON: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
const POINTS: [[f32; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];

fn text_stl() -> String {
    let mut text = String::from("solid a vertex of facets\n");
    for triangle in TETRAHEDRON {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for corner in triangle {
            let [x, y, z] = POINTS[corner];
            text += &format!("      vertex {x:e} {y} {z}\r\n");
        }
        text += "    endloop\n  endfacet\n";
    }
    text + "endsolid a\n"
}

fn binary_stl() -> Vec<u8> {
    // The header looks like text on purpose.
    let mut bytes = b"solid ".to_vec();
    bytes.resize(80, b' ');
    bytes.extend(4_u32.to_le_bytes());
    for triangle in TETRAHEDRON {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flat_map(|corner| POINTS[*corner]).flat_map(f32::to_le_bytes));
        bytes.extend([0; 2]);
    }
    bytes
}

const OBJ: &str = "# corners\nmtllib a.mtl\nv 0 0 0\nv 1 0 0 1 1 1\nv 0 1 0\nv 0 0 1\nvn 0 0 1\n\
    g one\nf 1//1 3//1 2//1\nf 1 2 4\ng two\nf -3/1/1 -2 -1\nf 1 4 3\n";

/// A tetrahedron in millimetres, lying about in a node that puts it right, shown twice.
const DAE: &str = r##"<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="millimeter" meter="0.001"/><up_axis>Y_UP</up_axis></asset>
  <library_geometries>
    <geometry id="g"><mesh>
      <source id="s">
        <float_array id="a" count="13">7 0 0 0 1 0 0 0 1 0 0 0 1</float_array>
        <technique_common><accessor source="#a" count="4" stride="3" offset="1"/></technique_common>
      </source>
      <vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
      <triangles count="2"><input semantic="VERTEX" source="#v" offset="1"/>
        <input semantic="NORMAL" source="#n" offset="0"/><p>9 0 9 2 9 1 9 0 9 1 9 3</p></triangles>
      <polylist count="2"><input semantic="VERTEX" source="#v" offset="0"/>
        <vcount>3 3</vcount><p>1 2 3 0 3 2</p></polylist>
      <lines count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1</p></lines>
    </mesh></geometry>
    <geometry id="not_shown"><mesh/></geometry>
  </library_geometries>
  <library_nodes><node id="n"><instance_geometry url="#g"/></node></library_nodes>
  <library_visual_scenes><visual_scene id="scene">
    <node id="outer">
      <translate>0 0 5000</translate>
      <rotate>0 0 1 90</rotate>
      <node><matrix>0 1000 0 0 -1000 0 0 0 0 0 1000 -5000 0 0 0 1</matrix>
        <instance_geometry url="#g"/></node>
      <node><scale>-1000 1000 1000</scale><instance_node url="#n"/></node>
    </node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>"##;

#[test]
fn every_format_gives_the_same_tetrahedron() {
    for mesh in
        [written("a.stl", text_stl()), written("a.STL", binary_stl()), written("a.obj", OBJ)]
    {
        assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (4, 4));
        assert!(is_closed(&mesh));
        assert!((volume(&mesh) - 1.0 / 6.0).abs() < 1e-7);
    }
}

#[test]
fn dae_units_nodes_and_instances_count() {
    let mesh = written("a.dae", DAE);
    assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (8, 8));
    assert!(is_closed(&mesh));
    assert!((volume(&mesh) - 2.0 / 6.0).abs() < 1e-6, "{}", volume(&mesh));
    // The first stands at the origin as it is, the second is mirrored, turned and lifted by 5 m.
    let (low, high) = mesh.bounds().unwrap();
    assert!((low.coords - Vector3::new(-1.0, -1.0, 0.0)).amax() < 1e-6, "{low}");
    assert!((high.coords - Vector3::new(1.0, 1.0, 6.0)).amax() < 1e-6, "{high}");
}

#[test]
fn the_whole_link_is_in_its_frame() {
    let robot = common::small_arm();
    let mesh = |name: &str, prefer| {
        link_mesh(&robot.links[robot.link_index(name).unwrap()], prefer).unwrap()
    };
    assert_eq!(mesh("flange", Prefer::Visual), None);
    let (low, high) = mesh("upper_arm", Prefer::Visual).unwrap().bounds().unwrap();
    assert!((low.coords - Vector3::new(0.0, -0.04, -0.04)).amax() < 2e-4, "{low}");
    assert!((high.coords - Vector3::new(0.2, 0.04, 0.04)).amax() < 2e-4, "{high}");
    assert!(mesh("sleeve", Prefer::Visual).is_some(), "collision bodies where there is no visual");
    assert_eq!(mesh("forearm", Prefer::Collision).unwrap().triangles.len(), 12);
}

fn any_shape() -> impl Strategy<Value = Shape> {
    let length = || 0.002..2.0_f64;
    prop_oneof![
        [length(), length(), length()].prop_map(|size| Shape::Box { size }),
        (length(), length()).prop_map(|(radius, length)| Shape::Cylinder { radius, length }),
        (length(), length()).prop_map(|(radius, length)| Shape::Capsule { radius, length }),
        length().prop_map(|radius| Shape::Sphere { radius }),
    ]
}

/// Volume, area, and the distance of a point of the surface from it.
fn exact(shape: &Shape, p: &Vector3<f64>) -> (f64, f64, f64) {
    match *shape {
        Shape::Box { size: [x, y, z] } => {
            let q = p.abs() - Vector3::new(x, y, z) / 2.0;
            (x * y * z, 2.0 * (x * y + y * z + z * x), q.max().abs())
        }
        Shape::Cylinder { radius: r, length } => {
            let inside = (r - p.xy().norm()).min(length / 2.0 - p.z.abs());
            (PI * r * r * length, 2.0 * PI * r * (r + length), inside.abs())
        }
        Shape::Capsule { radius: r, length } => {
            let nearest = Vector3::new(0.0, 0.0, p.z.clamp(-length / 2.0, length / 2.0));
            let volume = PI * r * r * (length + 4.0 / 3.0 * r);
            (volume, 2.0 * PI * r * (2.0 * r + length), (r - (p - nearest).norm()).abs())
        }
        Shape::Sphere { radius: r } => {
            (4.0 / 3.0 * PI * r * r * r, 4.0 * PI * r * r, (r - p.norm()).abs())
        }
        Shape::Mesh { .. } => unreachable!(),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Shapes are closed, point outward and keep within 0.2 mm of the surface, wherever they are.
    #[test]
    fn shapes_keep_their_sizes(
        shape in any_shape(),
        at in prop::array::uniform3(-1.0..1.0_f64),
        rpy in prop::array::uniform3(-3.0..3.0_f64),
    ) {
        let [roll, pitch, yaw] = rpy;
        let rotation = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
        let link_from_body = Transform::from_parts(Vector3::from(at), rotation);
        let mesh = load_body(&Body { link_from_body, shape: shape.clone() }).unwrap();
        prop_assert!(is_closed(&mesh));
        let (volume_m3, area_m2, _) = exact(&shape, &Vector3::zeros());
        let slack = 3e-4 * area_m2;
        prop_assert!((volume(&mesh) - volume_m3).abs() < slack, "{} {volume_m3}", volume(&mesh));
        for triangle in corners(&mesh) {
            // Corners, middles of the edges, middle.
            let [a, b, c] = triangle;
            for p in [a, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0, (a + b + c) / 3.0] {
                let p = link_from_body.inverse().point(&p.into()).coords;
                let (_, _, distance) = exact(&shape, &p);
                prop_assert!(distance < 0.2e-3 + 1e-6, "{distance}");
            }
        }
    }

    /// Scaling scales; mirroring keeps triangles outward; a rigid motion keeps everything.
    #[test]
    fn scale_and_place(scale in prop::array::uniform3(0.1..3.0_f64), signs in 0..8_u32) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.obj");
        std::fs::write(&path, OBJ).unwrap();
        let sign = |axis: u32| if signs & (1 << axis) == 0 { 1.0 } else { -1.0 };
        let [x, y, z] = scale;
        let scale = [x * sign(0), y * sign(1), z * sign(2)];
        let mesh = load_body(&body(Shape::Mesh { path: path.clone(), scale })).unwrap();
        prop_assert!((volume(&mesh) - x * y * z / 6.0).abs() < 1e-5);
    }
}

#[test]
fn fingerprints_follow_the_content() {
    let folder = tempfile::tempdir().unwrap();
    let (one, two) = (folder.path().join("a.obj"), folder.path().join("b.obj"));
    std::fs::write(&one, OBJ).unwrap();
    std::fs::write(&two, OBJ).unwrap();
    let print = |body: &Body| body_fingerprint(body).unwrap();
    assert_eq!(print(&file(&one)), print(&file(&two)));
    assert_eq!(print(&file(&one)).to_string().len(), 64);
    let scaled = body(Shape::Mesh { path: one.clone(), scale: [2.0, 1.0, 1.0] });
    let translation = Transform::from_parts(Vector3::x(), UnitQuaternion::identity());
    let moved = Body { link_from_body: translation, ..file(&one) };
    let shapes = [
        Shape::Sphere { radius: 1.0 },
        Shape::Cylinder { radius: 1.0, length: 1.0 },
        Shape::Capsule { radius: 1.0, length: 1.0 },
        Shape::Box { size: [1.0; 3] },
        Shape::Box { size: [1.0, 1.0, 2.0] },
    ];
    let mut all: Vec<_> = shapes.map(|shape| print(&body(shape))).to_vec();
    all.extend([print(&file(&one)), print(&scaled), print(&moved)]);
    std::fs::write(&two, OBJ.replace("v 1", "v 2")).unwrap();
    all.push(print(&file(&two)));
    let count = all.len();
    all.sort();
    all.dedup();
    assert_eq!(all.len(), count);
    let robot = common::small_arm();
    let forearm = &robot.links[robot.link_index("forearm").unwrap()];
    let of = |prefer| link_fingerprint(forearm, prefer).unwrap().unwrap();
    assert_ne!(of(Prefer::Visual), of(Prefer::Collision));
    assert_eq!(link_fingerprint(&robot.links[0], Prefer::Visual).unwrap(), None);
}
