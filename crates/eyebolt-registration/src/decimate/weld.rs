//! A mesh whose triangles share vertices wherever their corners are at the same place.

use eyebolt_robot::TriangleMesh;
use nalgebra::Point3;

/// The different places of the vertices, metres, and the triangles between them: those of three
/// different corners, each set of corners once, as it came first.
pub(super) fn welded(mesh: &TriangleMesh) -> (Vec<Point3<f64>>, Vec<[u32; 3]>) {
    let (points, place_of) = places(&mesh.vertices);
    let placed = |triangle: &[u32; 3]| triangle.map(|corner| place_of[corner as usize]);
    let triangles: Vec<[u32; 3]> = mesh.triangles.iter().map(placed).collect();
    let kept = first_of_each(&triangles);
    (points, kept.into_iter().map(|index| triangles[index]).collect())
}

/// The different places in the order of their first use, and the place of each vertex.
fn places(vertices: &[Point3<f32>]) -> (Vec<Point3<f64>>, Vec<u32>) {
    // Adding zero makes minus zero plus zero: the same place.
    let bits = |index: usize| vertices[index].coords.map(|x| (x + 0.0).to_bits());
    let mut order: Vec<([u32; 3], usize)> =
        (0..vertices.len()).map(|index| (bits(index).into(), index)).collect();
    order.sort_unstable();
    let mut points = Vec::new();
    let mut place_of = vec![0; vertices.len()];
    let mut groups: Vec<&[([u32; 3], usize)]> = order.chunk_by(|a, b| a.0 == b.0).collect();
    groups.sort_unstable_by_key(|group| group[0].1);
    for group in groups {
        for (_, index) in group {
            place_of[*index] = points.len() as u32;
        }
        points.push(vertices[group[0].1].cast());
    }
    (points, place_of)
}

/// The indices, in order, of the first triangle on each set of three different corners.
fn first_of_each(triangles: &[[u32; 3]]) -> Vec<usize> {
    let mut by_corners: Vec<([u32; 3], usize)> = triangles.iter().copied().zip(0..).collect();
    for (corners, _) in &mut by_corners {
        corners.sort_unstable();
    }
    by_corners.retain(|([a, b, c], _)| a != b && b != c);
    by_corners.sort_unstable();
    by_corners.dedup_by_key(|(corners, _)| *corners);
    let mut kept: Vec<usize> = by_corners.into_iter().map(|(_, index)| index).collect();
    kept.sort_unstable();
    kept
}
