//! Meshes to try things on, corners counter-clockwise as seen from outside.

use eyebolt_robot::TriangleMesh;
use nalgebra::{Isometry3, Point3, Vector3};
use std::f32::consts::TAU;

/// A mesh of the triangles, each with its own corners.
pub fn soup(triangles: &[[Vector3<f32>; 3]]) -> TriangleMesh {
    let vertices = triangles.iter().flatten().map(|v| Point3::from(*v)).collect();
    let triangles = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    TriangleMesh { vertices, triangles }
}

/// A box of full extents `size` about `centre`: eight vertices, twelve triangles.
pub fn cuboid(size: [f32; 3], centre: [f32; 3]) -> TriangleMesh {
    let (size, centre) = (Vector3::from(size), Point3::from(centre));
    let sign = |corner: usize, axis: usize| if corner >> axis & 1 == 0 { -0.5 } else { 0.5 };
    let vertex = |i| centre + Vector3::from([0, 1, 2].map(|a| sign(i, a))).component_mul(&size);
    let mut triangles = Vec::new();
    for axis in 0..3 {
        let (e, f) = (1u32 << ((axis + 1) % 3), 1u32 << ((axis + 2) % 3));
        let top = 1u32 << axis;
        triangles.extend([[0, e + f, e], [0, f, e + f]]);
        triangles.extend([[top, top + e, top + e + f], [top, top + e + f, top + f]]);
    }
    TriangleMesh { vertices: (0..8).map(vertex).collect(), triangles }
}

/// The sphere's octahedron, cut `cuts` times, each direction as far out as `radius` says.
pub fn star(cuts: u32, radius: impl Fn(&Vector3<f32>) -> f32) -> TriangleMesh {
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
    let placed: Vec<_> = triangles.iter().map(|t| t.map(|v| v * radius(&v))).collect();
    soup(&placed)
}

fn quarters([a, b, c]: &[Vector3<f32>; 3]) -> [[Vector3<f32>; 3]; 4] {
    let (ab, bc, ca) = ((a + b).normalize(), (b + c).normalize(), (c + a).normalize());
    [[*a, ab, ca], [ab, *b, bc], [ca, bc, *c], [ab, bc, ca]]
}

/// A closed cylinder along z from 0 to `length`.
pub fn cylinder(radius: f32, length: f32, segments: u32) -> TriangleMesh {
    let rim = |i: u32, z: f32| {
        let angle = TAU * (i % segments) as f32 / segments as f32;
        Vector3::new(radius * angle.cos(), radius * angle.sin(), z)
    };
    let mut triangles = Vec::new();
    for i in 0..segments {
        let (a, b, c, d) = (rim(i, 0.0), rim(i + 1, 0.0), rim(i + 1, length), rim(i, length));
        triangles.extend([[a, b, c], [a, c, d]]);
        triangles.extend([[Vector3::zeros(), b, a], [Vector3::new(0.0, 0.0, length), d, c]]);
    }
    soup(&triangles)
}

pub fn joined(meshes: &[TriangleMesh]) -> TriangleMesh {
    let mut all = TriangleMesh::default();
    for mesh in meshes {
        let first = all.vertices.len() as u32;
        all.vertices.extend(&mesh.vertices);
        all.triangles.extend(mesh.triangles.iter().map(|t| t.map(|i| i + first)));
    }
    all
}

pub fn moved(mesh: &TriangleMesh, by: &Isometry3<f64>) -> TriangleMesh {
    let vertices = mesh.vertices.iter().map(|v| (by * v.cast::<f64>()).cast()).collect();
    TriangleMesh { vertices, triangles: mesh.triangles.clone() }
}

/// The same surface with every other triangle turned over.
pub fn half_flipped(mesh: &TriangleMesh) -> TriangleMesh {
    let turn =
        |(i, [a, b, c]): (usize, &[u32; 3])| if i % 2 == 0 { [*a, *c, *b] } else { [*a, *b, *c] };
    let triangles = mesh.triangles.iter().enumerate().map(turn).collect();
    TriangleMesh { vertices: mesh.vertices.clone(), triangles }
}
