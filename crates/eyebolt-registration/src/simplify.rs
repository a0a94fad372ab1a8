//! Fewer triangles for drawing, all turned outward.

use crate::distance_field::DistanceField;
use crate::triangle::area_normal;
use eyebolt_robot::TriangleMesh;
use nalgebra::{Point3, Vector3};
use std::collections::HashMap;

/// Vertices in one cubic cell of `cell_m` become their mean; triangles that collapse go
/// (Rossignac and Borrel, 1993). No surface moves by more than a cell's diagonal.
pub(crate) fn simplified(mesh: &TriangleMesh, cell_m: f32) -> TriangleMesh {
    let mut cells: HashMap<[i32; 3], u32> = HashMap::new();
    let mut sums: Vec<(Vector3<f64>, f64)> = Vec::new();
    let merged: Vec<u32> = mesh
        .vertices
        .iter()
        .map(|vertex| {
            let key = [0, 1, 2].map(|axis| (vertex[axis] / cell_m).floor() as i32);
            let cell = *cells.entry(key).or_insert_with(|| {
                sums.push((Vector3::zeros(), 0.0));
                sums.len() as u32 - 1
            });
            let (sum, count) = &mut sums[cell as usize];
            *sum += vertex.coords.cast::<f64>();
            *count += 1.0;
            cell
        })
        .collect();
    let vertices = sums.iter().map(|(sum, count)| Point3::from((sum / *count).cast())).collect();
    let mut triangles: Vec<[u32; 3]> = mesh
        .triangles
        .iter()
        .map(|triangle| triangle.map(|corner| merged[corner as usize]))
        .filter(|[a, b, c]| a != b && b != c && c != a)
        .map(|[a, b, c]| match a.min(b).min(c) {
            first if first == a => [a, b, c],
            first if first == b => [b, c, a],
            _ => [c, a, b],
        })
        .collect();
    triangles.sort_unstable();
    triangles.dedup();
    TriangleMesh { vertices, triangles }
}

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
