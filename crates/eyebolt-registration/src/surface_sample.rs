//! Points spread over the outside of a mesh.

use crate::distance_field::DistanceField;
use crate::triangle::area_normal;
use eyebolt_robot::TriangleMesh;
use nalgebra::{Point3, Vector3};

/// A point of a link's outside, link frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Where, metres.
    pub point: Point3<f32>,
    /// Outward unit normal.
    pub normal: Vector3<f32>,
}

/// Farther than this from the field's zero, a point lies on something inside the link.
const OUTSIDE_M: f32 = 0.002;

/// How far to either side of a triangle its outside is looked for, metres.
const PROBE_M: f32 = 0.006;

/// About `count` points, each standing for the same area: no chance, so the same every time.
pub(crate) fn sample_surface(
    mesh: &TriangleMesh,
    field: &DistanceField,
    count: usize,
) -> Vec<SurfacePoint> {
    let corners: Vec<[Point3<f32>; 3]> =
        mesh.triangles.iter().map(|t| t.map(|i| mesh.vertices[i as usize])).collect();
    let area = |triangle: &[Point3<f32>; 3]| 0.5 * f64::from(area_normal(triangle).norm());
    let outer: f64 = corners.iter().filter(|t| is_outer(field, t)).map(area).sum();
    if outer <= 0.0 || outer.is_nan() {
        return Vec::new();
    }
    let spacing = outer / count as f64;
    let mut owed = 0.5 * spacing;
    let mut index = 0u32;
    let mut points = Vec::with_capacity(count + 1);
    for triangle in corners.iter().filter(|t| is_outer(field, t)) {
        owed += area(triangle);
        while owed >= spacing {
            owed -= spacing;
            index += 1;
            points.extend(on_triangle(triangle, field, index));
        }
    }
    points
}

fn is_outer(field: &DistanceField, [a, b, c]: &[Point3<f32>; 3]) -> bool {
    let middle = Point3::from((a.coords + b.coords + c.coords) / 3.0);
    field.sample(&middle).distance_m.abs() < OUTSIDE_M
}

fn on_triangle(
    [a, b, c]: &[Point3<f32>; 3],
    field: &DistanceField,
    index: u32,
) -> Option<SurfacePoint> {
    // Additive recurrence on the plastic number: evenly spread pairs without a random generator.
    let (x, y) =
        (f64::from(index) * 0.754_877_666_246_692_7, f64::from(index) * 0.569_840_290_998_053_2);
    let (mut u, mut v) = (x.fract() as f32, y.fract() as f32);
    if u + v > 1.0 {
        (u, v) = (1.0 - u, 1.0 - v);
    }
    let point = a + (b - a) * u + (c - a) * v;
    let flat = area_normal(&[*a, *b, *c]).try_normalize(1e-20)?;
    // Beside an edge the gradient may point anywhere: what lies off either face tells.
    let side = |reach: f32| field.sample(&(point + flat * reach)).distance_m;
    let normal = if side(PROBE_M) < side(-PROBE_M) { -flat } else { flat };
    Some(SurfacePoint { point, normal })
}
