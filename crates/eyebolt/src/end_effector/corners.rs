//! Corners of a shape: where many directions find its outermost point.
//!
//! The outermost points are those of the convex hull. They are seen from most sides, and how many
//! directions agree on one is the solid angle of its normals: an eighth of all at the corner of a
//! box, next to nothing on flats and round sides. None of this depends on how a surface is cut into
//! triangles.

use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Directions that are asked.
const DIRECTIONS: usize = 2000;
/// Outermost points nearer to each other than this share of the size are one corner, rounded.
const ROUNDING: f64 = 0.04;

/// A point that stands out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// The number of its part.
    pub(super) part: usize,
    /// Where it is.
    pub(super) point: Point3<f64>,
    /// Share of all directions in which it, or what is right beside it, is outermost.
    pub(super) sharpness: f64,
}

/// The outermost of `vertices`, which are numbered by part; `size_m` is about how large the shape is.
pub(super) fn corners(vertices: &[(usize, Point3<f64>)], size_m: f64) -> Vec<Corner> {
    let outermost: Vec<Option<usize>> =
        (0..DIRECTIONS).into_par_iter().map(|at| outermost(vertices, &direction(at))).collect();
    let mut counts = BTreeMap::<usize, usize>::new();
    for vertex in outermost.into_iter().flatten() {
        *counts.entry(vertex).or_default() += 1;
    }
    let near_m = ROUNDING * size_m;
    let sharpness = |point: &Point3<f64>| {
        let beside =
            counts.iter().filter(|(other, _)| (vertices[**other].1 - point).norm() < near_m);
        beside.map(|(_, count)| count).sum::<usize>() as f64 / DIRECTIONS as f64
    };
    let corner = |vertex: &usize| {
        let (part, point) = vertices[*vertex];
        Corner { part, point, sharpness: sharpness(&point) }
    };
    counts.keys().map(corner).collect()
}

fn outermost(vertices: &[(usize, Point3<f64>)], direction: &Vector3<f64>) -> Option<usize> {
    let height = |vertex: &(usize, Point3<f64>)| vertex.1.coords.dot(direction);
    let heights = vertices.iter().map(height).enumerate();
    heights.max_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(vertex, _)| vertex)
}

/// Direction `index` of a spiral over the sphere (Fibonacci lattice).
fn direction(index: usize) -> Vector3<f64> {
    let z = 1.0 - (2.0 * index as f64 + 1.0) / DIRECTIONS as f64;
    let angle = index as f64 * std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let radius = (1.0 - z * z).sqrt();
    Vector3::new(radius * angle.cos(), radius * angle.sin(), z)
}
