//! Only the triangles that can be seen from outside, all turned outward.

use crate::distance_field::DistanceField;
use crate::triangle::{area_normal, spread_points};
use eyebolt_robot::TriangleMesh;
use nalgebra::Point3;

/// How far to either side of a triangle its outside is looked for, metres.
const PROBE_M: f32 = 0.006;

/// The triangles of `mesh` that can be seen from outside, corners counter-clockwise as seen from
/// there, whatever way the file had them. Sheets that can be seen from both sides come twice.
pub(crate) fn outward(mesh: &TriangleMesh, field: &DistanceField) -> TriangleMesh {
    let mut triangles = Vec::with_capacity(mesh.triangles.len());
    for &[a, b, c] in &mesh.triangles {
        let corners = [a, b, c].map(|corner| mesh.vertices[corner as usize]);
        let Some(normal) = area_normal(&corners).try_normalize(1e-20) else { continue };
        // Where its sides are clearest: some of a large triangle may run through other parts.
        let sides = |place: &Point3<f32>| {
            [PROBE_M, -PROBE_M].map(|reach| field.sample(&(place + normal * reach)).distance_m)
        };
        let clear =
            |place: &Point3<f32>| sides(place).into_iter().fold(f32::NEG_INFINITY, f32::max);
        let places = spread_points(&corners, 2.0 * PROBE_M);
        let clearest = places.max_by(|a, b| clear(a).total_cmp(&clear(b)));
        let Some(place) = clearest else { continue };
        if field.sample(&place).distance_m < -PROBE_M {
            continue;
        }
        let [front, back] = sides(&place);
        let sheet = front > 0.0 && back > 0.0;
        if sheet || front >= back {
            triangles.push([a, b, c]);
        }
        if sheet || front < back {
            triangles.push([a, c, b]);
        }
    }
    TriangleMesh { vertices: mesh.vertices.clone(), triangles }
}
