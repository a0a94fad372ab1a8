//! Meshes of few enough triangles to hand on.

use eyebolt_robot::TriangleMesh;
use nalgebra::Point3;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Edge of the first grid that vertices are put together in, metres; it doubles until few enough
/// triangles are left.
const FIRST_CELL_M: f32 = 0.002;
const LAST_CELL_M: f32 = 0.1;

/// `meshes`, coarse enough to have `most` triangles together.
pub(super) fn few_enough(meshes: &[&TriangleMesh], most: usize) -> Vec<TriangleMesh> {
    let mut coarse: Vec<TriangleMesh> = meshes.iter().map(|mesh| (*mesh).clone()).collect();
    let mut cell_m = FIRST_CELL_M;
    while coarse.iter().map(|mesh| mesh.triangles.len()).sum::<usize>() > most
        && cell_m <= LAST_CELL_M
    {
        coarse = meshes.par_iter().map(|mesh| clustered(mesh, cell_m)).collect();
        cell_m *= 2.0;
    }
    coarse
}

/// `mesh` with all vertices in one cell of a grid put together in their mean (Rossignac and Borrel,
/// Multi-resolution 3D approximations, 1993), without the triangles that this makes nothing of.
fn clustered(mesh: &TriangleMesh, cell_m: f32) -> TriangleMesh {
    let mut cells: BTreeMap<[i32; 3], usize> = BTreeMap::new();
    let mut sums: Vec<(Point3<f32>, f32)> = Vec::new();
    let mut of_vertex: Vec<u32> = Vec::with_capacity(mesh.vertices.len());
    for vertex in &mesh.vertices {
        let cell = [vertex.x, vertex.y, vertex.z].map(|c| (c / cell_m).floor() as i32);
        let index = *cells.entry(cell).or_insert(sums.len());
        if index == sums.len() {
            sums.push((Point3::origin(), 0.0));
        }
        sums[index].0 += vertex.coords;
        sums[index].1 += 1.0;
        of_vertex.push(index as u32);
    }
    let merged = mesh.triangles.iter().map(|t| t.map(|vertex| of_vertex[vertex as usize]));
    let triangles = merged.filter(|[a, b, c]| a != b && b != c && c != a).collect();
    let vertices = sums.iter().map(|(sum, count)| sum / *count).collect();
    TriangleMesh { vertices, triangles }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A flat square of `n` by `n` cells, 1 m wide.
    fn square(n: u32) -> TriangleMesh {
        let vertices = (0..=n).flat_map(|v| {
            (0..=n).map(move |u| Point3::new(u as f32 / n as f32, v as f32 / n as f32, 0.0))
        });
        let at = |u: u32, v: u32| v * (n + 1) + u;
        let triangles = (0..n).flat_map(|v| {
            (0..n).flat_map(move |u| {
                let [a, b] = [at(u, v), at(u + 1, v)];
                let [c, d] = [at(u, v + 1), at(u + 1, v + 1)];
                [[a, b, d], [a, d, c]]
            })
        });
        TriangleMesh { vertices: vertices.collect(), triangles: triangles.collect() }
    }

    #[test]
    fn clustering_keeps_the_surface_to_a_cell_and_needs_fewer_triangles() {
        let fine = square(100);
        let coarse = clustered(&fine, 0.05);
        assert!(coarse.triangles.len() * 10 < fine.triangles.len());
        let area = |mesh: &TriangleMesh| {
            let corner = |vertex: u32| mesh.vertices[vertex as usize];
            let areas = mesh.triangles.iter().map(|[a, b, c]| {
                0.5 * (corner(*b) - corner(*a)).cross(&(corner(*c) - corner(*a))).z
            });
            areas.sum::<f32>()
        };
        // Only the rim is drawn in, by half a cell.
        assert!((0.85..=1.0).contains(&area(&coarse)), "{}", area(&coarse));
    }

    const MOST: usize = 100_000;

    #[test]
    fn meshes_of_a_robot_are_few_enough_together() {
        let fine = square(200);
        let few = few_enough(&[&fine, &fine], MOST);
        assert!(few.iter().map(|mesh| mesh.triangles.len()).sum::<usize>() <= MOST);
        let small = square(10);
        assert_eq!(few_enough(&[&small], MOST)[0], small);
    }
}
