//! Meshes and random scenes of them.

use eyebolt_geometry::{Camera, Distortion, Link, PinholeCamera, Transform};
use eyebolt_render::PosedMesh;
use eyebolt_robot::TriangleMesh;
use nalgebra::{Point3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

/// The same cases every time, and no files of failures.
pub fn config(cases: u32) -> Config {
    Config { cases, rng_seed: RngSeed::Fixed(7), failure_persistence: None, ..Config::default() }
}

/// A mesh and where it is.
#[derive(Clone, Debug)]
pub struct Object {
    pub mesh: TriangleMesh,
    pub camera_from_link: Transform<Camera, Link>,
    pub link: u8,
}

pub fn posed(objects: &[Object]) -> Vec<PosedMesh<'_>> {
    objects
        .iter()
        .map(|o| PosedMesh { mesh: &o.mesh, camera_from_link: o.camera_from_link, link: o.link })
        .collect()
}

/// 96 x 72 pixels, about 56 by 44 degrees.
pub fn camera(lens: Distortion) -> PinholeCamera {
    PinholeCamera::new(96, 72, 90.0, 88.0, 47.2, 36.1, lens).unwrap()
}

pub fn lens() -> impl Strategy<Value = Distortion> {
    let k = || -0.15..0.15_f64;
    let p = || -0.004..0.004_f64;
    (k(), k(), p(), p()).prop_map(|(k1, k2, p1, p2)| Distortion::plumb_bob([k1, k2, p1, p2, 0.0]))
}

/// A mesh of the triangles, each with its own corners.
pub fn soup(triangles: &[[Vector3<f32>; 3]]) -> TriangleMesh {
    let vertices = triangles.iter().flatten().map(|v| Point3::from(*v)).collect();
    let triangles = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    TriangleMesh { vertices, triangles }
}

/// A sphere about the origin: an octahedron, each triangle cut in four `cuts` times.
pub fn sphere(radius: f32, cuts: u32) -> TriangleMesh {
    let mut triangles = Vec::new();
    for octant in 0..8 {
        let sign = |bit: usize| if octant >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let [a, b, c] = [0, 1, 2].map(|axis| Vector3::ith(axis, sign(axis)));
        let right_handed = sign(0) * sign(1) * sign(2) > 0.0;
        triangles.push(if right_handed { [a, b, c] } else { [a, c, b] });
    }
    for _ in 0..cuts {
        triangles = triangles.iter().flat_map(quarters).collect();
    }
    let scaled: Vec<_> = triangles.iter().map(|t| t.map(|v| v * radius)).collect();
    soup(&scaled)
}

fn quarters([a, b, c]: &[Vector3<f32>; 3]) -> [[Vector3<f32>; 3]; 4] {
    let (ab, bc, ca) = ((a + b).normalize(), (b + c).normalize(), (c + a).normalize());
    [[*a, ab, ca], [ab, *b, bc], [ca, bc, *c], [ab, bc, ca]]
}

/// A box about the origin, each face cut into `cuts` x `cuts` squares.
pub fn cuboid(size: Vector3<f32>, cuts: usize) -> TriangleMesh {
    let mut triangles = Vec::new();
    for axis in 0..3 {
        let (e, f) = (Vector3::ith((axis + 1) % 3, 1.0), Vector3::ith((axis + 2) % 3, 1.0));
        for side in [-1.0, 1.0] {
            let corner = |i: usize, j: usize| -> Vector3<f32> {
                let along = |n: usize| 2.0 * n as f32 / cuts as f32 - 1.0;
                let unit = Vector3::ith(axis, side) + e * along(i) + f * along(j);
                unit.component_mul(&size) * 0.5
            };
            for (i, j) in (0..cuts).flat_map(|i| (0..cuts).map(move |j| (i, j))) {
                let [a, b, c, d] =
                    [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
                triangles.extend(match side > 0.0 {
                    true => [[a, b, c], [a, c, d]],
                    false => [[a, c, b], [a, d, c]],
                });
            }
        }
    }
    soup(&triangles)
}

pub fn rotation() -> impl Strategy<Value = UnitQuaternion<f64>> {
    let half = || -3.0..3.0_f64;
    [half(), half(), half()].prop_map(|v| UnitQuaternion::new(Vector3::from(v)))
}

/// Where an object may be: in the image, over its edge, out of it; `depth` before the camera.
pub fn pose(depth: std::ops::Range<f64>) -> impl Strategy<Value = Transform<Camera, Link>> {
    (-0.7..0.7_f64, -0.6..0.6_f64, depth, rotation())
        .prop_map(|(x, y, z, r)| Transform::from_parts(Vector3::new(x, y, z), r))
}

fn mesh() -> impl Strategy<Value = TriangleMesh> {
    let size = || 0.08..0.35_f32;
    prop_oneof![
        (size(), 2..4_u32).prop_map(|(r, cuts)| sphere(0.6 * r, cuts)),
        ([size(), size(), size()], 1..7_usize).prop_map(|(s, cuts)| cuboid(s.into(), cuts)),
    ]
}

/// One to three closed meshes `depth` before the camera, each its own link.
pub fn scene(depth: std::ops::Range<f64>) -> impl Strategy<Value = Vec<Object>> {
    prop::collection::vec((mesh(), pose(depth)), 1..4).prop_map(|objects| {
        let object = |(link, (mesh, camera_from_link))| Object {
            mesh,
            camera_from_link,
            link: link as u8 + 3,
        };
        objects.into_iter().enumerate().map(object).collect()
    })
}
