//! Only the triangles that can be seen from outside, all turned outward.

use crate::distance_field::DistanceField;
use crate::triangle::area_normal;
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
        let [pa, pb, pc] = corners;
        let middle = Point3::from((pa.coords + pb.coords + pc.coords) / 3.0);
        let side = |reach: f32| field.sample(&(middle + normal * reach)).distance_m;
        if side(0.0) < -PROBE_M {
            continue;
        }
        let (front, back) = (side(PROBE_M), side(-PROBE_M));
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
