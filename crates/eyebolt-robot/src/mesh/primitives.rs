//! Boxes, cylinders, capsules and spheres as triangles.

use super::error::{Fault, check_count};
use super::raw::RawMesh;
use crate::robot::Shape;
use nalgebra::Point3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// How far a facet may lie inside the round surface along one direction, metres. On spheres two
/// directions add up, hence half of the 0.2 mm that is promised.
const SAG: f64 = 1e-4;

/// What messages call the shape.
pub(super) fn name(shape: &Shape) -> &'static str {
    match shape {
        Shape::Mesh { .. } => "mesh",
        Shape::Box { .. } => "box",
        Shape::Cylinder { .. } => "cylinder",
        Shape::Capsule { .. } => "capsule",
        Shape::Sphere { .. } => "sphere",
    }
}

/// Triangles of a shape in its own frame. Vertices lie on the surface; a mesh file gives none.
pub(super) fn tessellate(shape: &Shape) -> Result<RawMesh, Fault> {
    match *shape {
        Shape::Mesh { .. } => Ok(RawMesh::default()),
        Shape::Box { size } => Ok(cuboid(size)),
        Shape::Cylinder { radius, length } => {
            let half = length / 2.0;
            revolve(&[(0.0, -half), (radius, -half), (radius, half), (0.0, half)], radius)
        }
        Shape::Sphere { radius } => revolve(&rounded_profile(radius, 0.0)?, radius),
        Shape::Capsule { radius, length } => revolve(&rounded_profile(radius, length)?, radius),
    }
}

fn cuboid([x, y, z]: [f64; 3]) -> RawMesh {
    let sign = |bit: u32| if bit == 0 { -0.5 } else { 0.5 };
    let corner = |i: u32| point(x * sign(i & 1), y * sign(i & 2), z * sign(i & 4));
    let quads =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    RawMesh { positions: (0..8).map(corner).collect(), triangles }
}

/// Facets around a circle that keep within [`SAG`].
fn facets(radius: f64) -> Result<usize, Fault> {
    // A chord over the angle 2a lies r (1 - cos a) inside.
    // At least ten, so that small ones stay round.
    let cosine = (1.0 - SAG / radius).max(0.95);
    let count = (PI / cosine.acos()).ceil();
    // Not finite where the radius is so large that the cosine rounds to 1.
    if count < 1e6 { Ok(count as usize) } else { Err(Fault::TooManyTriangles) }
}

/// (radius, z) from the bottom to the top of a sphere whose halves are `length` apart.
fn rounded_profile(radius: f64, length: f64) -> Result<Vec<(f64, f64)>, Fault> {
    let quarter = facets(radius)?.div_ceil(4);
    let arc = |i: usize| {
        let angle = FRAC_PI_2 * i as f64 / quarter as f64;
        (if i == quarter { 0.0 } else { radius * angle.cos() }, radius * angle.sin())
    };
    let half = length / 2.0;
    let bottom = (0..=quarter).rev().map(arc).map(|(r, z)| (r, -half - z));
    // Without a cylinder between, the two halves share their circle.
    let top = (usize::from(length == 0.0)..=quarter).map(arc).map(|(r, z)| (r, half + z));
    Ok(bottom.chain(top).collect())
}

/// Turns a profile (radius, z) from bottom to top about z. It starts and ends on the axis.
fn revolve(profile: &[(f64, f64)], radius: f64) -> Result<RawMesh, Fault> {
    let around = facets(radius)?;
    check_count(around.saturating_mul(2 * profile.len()))?;
    let mut mesh = RawMesh::default();
    for (r, z) in profile {
        mesh.positions.extend((0..around).map(|i| {
            let angle = TAU * i as f64 / around as f64;
            point(r * angle.cos(), r * angle.sin(), *z)
        }));
    }
    let rings = profile.len().saturating_sub(1);
    let (around, rings) = (around as u32, rings as u32);
    for ring in 0..rings {
        for i in 0..around {
            let (a, b) = (ring * around + i, ring * around + (i + 1) % around);
            let (c, d) = (a + around, b + around);
            // Where the profile meets the axis, one of the two has no area and is dropped.
            mesh.triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    Ok(mesh)
}

fn point(x: f64, y: f64, z: f64) -> Point3<f32> {
    Point3::new(x as f32, y as f32, z as f32)
}
