//! Points spread over the end-effector's surface.

use super::shape::Part;
use nalgebra::Point3;

/// The generalised golden ratio in two dimensions: its powers spread pairs evenly (Roberts 2018).
const PLASTIC: f64 = 1.324_717_957_244_746;

/// `count` points with the number of their part, each standing for the same area; link frame. No
/// chance, so the same every time.
pub(super) fn spread(parts: &[Part], count: usize) -> Vec<(usize, Point3<f64>)> {
    let triangles: Vec<(usize, [Point3<f64>; 3])> = parts
        .iter()
        .enumerate()
        .flat_map(|(number, part)| {
            let vertices = &part.mesh.vertices;
            let corners =
                |triangle: &[u32; 3]| triangle.map(|i| vertices[i as usize].cast::<f64>());
            part.mesh.triangles.iter().map(move |triangle| (number, corners(triangle)))
        })
        .collect();
    let area = |[a, b, c]: &[Point3<f64>; 3]| 0.5 * (b - a).cross(&(c - a)).norm();
    let total: f64 = triangles.iter().map(|(_, corners)| area(corners)).sum();
    let spacing = total / count as f64;
    let mut points = Vec::with_capacity(count);
    let mut reached = 0.0;
    for (number, corners) in &triangles {
        reached += area(corners);
        while points.len() < count && (points.len() as f64 + 0.5) * spacing < reached {
            points.push((*number, on_triangle(corners, points.len())));
        }
    }
    points
}

fn on_triangle([a, b, c]: &[Point3<f64>; 3], index: usize) -> Point3<f64> {
    let number = index as f64 + 1.0;
    let (u, v) = ((number / PLASTIC).fract(), (number / (PLASTIC * PLASTIC)).fract());
    let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
    a + u * (b - a) + v * (c - a)
}
