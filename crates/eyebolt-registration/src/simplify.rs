//! Fewer triangles for drawing.

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
