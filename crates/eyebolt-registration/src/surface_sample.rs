//! Points spread over the outside of a mesh.

use crate::distance_field::DistanceField;
use crate::triangle::{area_normal, corners, spread_points};
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
    let corners = corners(mesh);
    let area = |triangle: &[Point3<f32>; 3]| 0.5 * f64::from(area_normal(triangle).norm());
    let shares: Vec<f64> = corners.iter().map(|t| outer_share(field, t)).collect();
    let outer: f64 = corners.iter().zip(&shares).map(|(t, share)| share * area(t)).sum();
    if outer <= 0.0 || outer.is_nan() {
        return Vec::new();
    }
    let spacing = outer / count as f64;
    let mut owed = 0.5 * spacing;
    let mut index = 0u32;
    let mut points = Vec::with_capacity(count + 1);
    for (triangle, _) in corners.iter().zip(&shares).filter(|(_, share)| **share > 0.0) {
        owed += area(triangle);
        while owed >= spacing {
            owed -= spacing;
            index += 1;
            points.extend(on_triangle(triangle, field, index));
        }
    }
    points
}

/// How much of a triangle is outside: some of a large one may run through other parts.
fn outer_share(field: &DistanceField, triangle: &[Point3<f32>; 3]) -> f64 {
    let Some(normal) = area_normal(triangle).try_normalize(1e-20) else { return 0.0 };
    let (mut all, mut outer) = (0.0, 0.0);
    for p in spread_points(triangle, 2.0 * PROBE_M) {
        let at_surface = field.sample(&p).distance_m.abs() < OUTSIDE_M;
        all += 1.0;
        outer += if at_surface && is_open(field, &p, &normal) { 1.0 } else { 0.0 };
    }
    outer / all
}

/// Whether there is nothing a little off at least one face.
fn is_open(field: &DistanceField, point: &Point3<f32>, normal: &Vector3<f32>) -> bool {
    [PROBE_M, -PROBE_M]
        .iter()
        .any(|reach| field.sample(&(point + normal * *reach)).distance_m > 0.0)
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
    if !is_open(field, &point, &flat) {
        return None;
    }
    // Beside an edge the gradient may point anywhere: what lies off either face tells.
    let side = |reach: f32| field.sample(&(point + flat * reach)).distance_m;
    let normal = if side(PROBE_M) < side(-PROBE_M) { -flat } else { flat };
    Some(SurfacePoint { point, normal })
}
