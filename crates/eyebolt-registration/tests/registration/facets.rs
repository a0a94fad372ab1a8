//! Distances by trying every triangle, inside and outside by the solid angle, in double precision.

use eyebolt_robot::TriangleMesh;
use nalgebra::{Point3, Vector3};
use std::f64::consts::TAU;

/// The triangles of a mesh.
pub struct Facets(Vec<[Point3<f64>; 3]>);

impl Facets {
    pub fn of(mesh: &TriangleMesh) -> Self {
        let corner = |i: u32| mesh.vertices[i as usize].cast();
        Self(mesh.triangles.iter().map(|t| t.map(corner)).collect())
    }

    /// Distance from `p` to the nearest triangle.
    pub fn distance(&self, p: &Point3<f64>) -> f64 {
        self.0.iter().map(|t| to_triangle(p, t)).fold(f64::INFINITY, f64::min)
    }

    /// Whether a closed surface goes around `p` (van Oosterom and Strackee, 1983).
    pub fn is_inside(&self, p: &Point3<f64>) -> bool {
        let angles = self.0.iter().map(|corners| {
            let [a, b, c] = corners.map(|corner| corner - p);
            let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
            let below = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
            2.0 * a.dot(&b.cross(&c)).atan2(below)
        });
        angles.sum::<f64>().abs() > TAU
    }
}

fn to_triangle(p: &Point3<f64>, [a, b, c]: &[Point3<f64>; 3]) -> f64 {
    let normal = (b - a).cross(&(c - a)).normalize();
    let above = normal.dot(&(p - a));
    let foot = p - normal * above;
    let left_of = |a: &Point3<f64>, b: &Point3<f64>| (b - a).cross(&(foot - a)).dot(&normal) >= 0.0;
    if left_of(a, b) && left_of(b, c) && left_of(c, a) {
        return above.abs();
    }
    to_segment(p, a, b).min(to_segment(p, b, c)).min(to_segment(p, c, a))
}

fn to_segment(p: &Point3<f64>, a: &Point3<f64>, b: &Point3<f64>) -> f64 {
    let along: Vector3<f64> = b - a;
    let share = (along.dot(&(p - a)) / along.norm_squared()).clamp(0.0, 1.0);
    (a + along * share - p).norm()
}
