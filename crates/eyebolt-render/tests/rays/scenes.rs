//! Random triangles, rays and places.

use eyebolt_geometry::{Base, Camera, Distortion, Link, PinholeCamera, Transform};
use eyebolt_render::{RayScene, SceneMesh};
use eyebolt_robot::TriangleMesh;
use nalgebra::{Point3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

/// The same cases every time, and no files of failures.
pub fn config(cases: u32) -> Config {
    Config { cases, rng_seed: RngSeed::Fixed(7), failure_persistence: None, ..Config::default() }
}

/// A mesh of the triangles, each with its own corners.
pub fn soup(triangles: &[[Vector3<f32>; 3]]) -> TriangleMesh {
    let vertices = triangles.iter().flatten().map(|v| Point3::from(*v)).collect();
    let triangles = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    TriangleMesh { vertices, triangles }
}

/// Meshes that are where they are.
pub fn scene(meshes: &[TriangleMesh]) -> RayScene {
    let base_from_mesh = Transform::identity();
    let posed: Vec<_> = meshes.iter().map(|mesh| SceneMesh { mesh, base_from_mesh }).collect();
    RayScene::new(&posed)
}

/// A sphere about the origin: rings of corners, so that poles are shared by many triangles.
pub fn sphere(radius: f64, rings: u32) -> TriangleMesh {
    let (around, mut vertices) = (2 * rings, Vec::new());
    for ring in 0..=rings {
        for step in 0..around {
            let polar = std::f64::consts::PI * f64::from(ring) / f64::from(rings);
            let azimuth = std::f64::consts::PI * f64::from(step) / f64::from(rings);
            // The ends of the meridians are one point each.
            let sine = if ring % rings == 0 { 0.0 } else { polar.sin() };
            let unit = Vector3::new(sine * azimuth.cos(), sine * azimuth.sin(), polar.cos());
            vertices.push(Point3::from(unit * radius).cast());
        }
    }
    let mut triangles = Vec::new();
    for (ring, step) in (0..rings).flat_map(|ring| (0..around).map(move |step| (ring, step))) {
        let at = |ring: u32, step: u32| ring * around + step % around;
        let [a, b] = [at(ring, step), at(ring, step + 1)];
        let [c, d] = [at(ring + 1, step), at(ring + 1, step + 1)];
        triangles.extend([[a, c, d], [a, d, b]]);
    }
    TriangleMesh { vertices, triangles }
}

pub fn vector(limit: f64) -> impl Strategy<Value = Vector3<f64>> {
    [-limit..limit, -limit..limit, -limit..limit].prop_map(Vector3::from)
}

pub fn rotation() -> impl Strategy<Value = UnitQuaternion<f64>> {
    vector(3.0).prop_map(UnitQuaternion::new)
}

pub fn pose() -> impl Strategy<Value = Transform<Base, Link>> {
    (vector(0.5), rotation()).prop_map(|(t, r)| Transform::from_parts(t, r))
}

pub fn eye() -> impl Strategy<Value = Transform<Base, Camera>> {
    (vector(1.5), rotation()).prop_map(|(t, r)| Transform::from_parts(t, r))
}

/// Coordinates from a coarse grid as often as any: edges that meet, flat boxes, rays in planes.
fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![-1.0..1.0_f32, (-2..=2_i8).prop_map(|i| f32::from(i) * 0.5)]
}

fn corner() -> impl Strategy<Value = Vector3<f32>> {
    [coordinate(), coordinate(), coordinate()].prop_map(Vector3::from)
}

/// Large ones, small ones, slivers, lines and points.
pub fn triangle() -> impl Strategy<Value = [Vector3<f32>; 3]> {
    let small = (corner(), [corner(), corner()], -3..0_i32)
        .prop_map(|(a, [b, c], e)| [a, a + b * 10_f32.powi(e), a + c * 10_f32.powi(e)]);
    let line = (corner(), corner()).prop_map(|(a, b)| [a, a + (b - a) * 0.5, b]);
    prop_oneof![
        4 => [corner(), corner(), corner()],
        4 => small,
        1 => line,
        1 => (corner(), corner()).prop_map(|(a, b)| [a, b, b]),
        1 => corner().prop_map(|a| [a, a, a]),
    ]
}

/// Up to four meshes of a hundred triangles together.
pub fn triangles() -> impl Strategy<Value = Vec<Vec<[Vector3<f32>; 3]>>> {
    prop::collection::vec(prop::collection::vec(triangle(), 0..40), 0..4)
}

/// Along axes and to points of the grid as often as anywhere.
pub fn ray() -> impl Strategy<Value = (Point3<f64>, Vector3<f64>)> {
    let axis = (0..3_usize, prop::bool::ANY)
        .prop_map(|(axis, up)| Vector3::ith(axis, if up { 1.0 } else { -1.0 }));
    let to_grid = (corner(), corner()).prop_map(|(a, b)| (a - b).cast::<f64>());
    let direction = prop_oneof![axis, to_grid, vector(1.0)];
    let origin = prop_oneof![corner().prop_map(|v| v.cast()), vector(3.0)];
    let length = (-6..6_i32).prop_map(|e| 10_f64.powi(e));
    (origin, direction, length)
        .prop_filter("a direction", |(_, d, _)| d.norm() > 0.01)
        .prop_map(|(o, d, length)| (Point3::from(o), d * length))
}

/// A size that ends within tiles, with or without a lens.
pub fn camera() -> impl Strategy<Value = PinholeCamera> {
    let k = || -0.15..0.15_f64;
    let lens = prop_oneof![
        Just(Distortion::None),
        (k(), k()).prop_map(|(k1, k2)| Distortion::plumb_bob([k1, k2, 0.002, -0.003, 0.0])),
    ];
    (1..70_u32, 1..50_u32, lens).prop_map(|(width, height, lens)| {
        let (cx, cy) = (0.45 * f64::from(width), 0.55 * f64::from(height));
        PinholeCamera::new(width, height, 40.0, 42.0, cx, cy, lens).unwrap()
    })
}
