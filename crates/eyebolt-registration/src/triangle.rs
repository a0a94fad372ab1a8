//! The point of a triangle nearest to a given point.

use eyebolt_robot::TriangleMesh;
use nalgebra::{Point3, Vector3};

/// Nearest point of triangle `[a, b, c]` to `p` (Ericson, *Real-Time Collision Detection*, 5.1.5).
///
/// Correct for triangles of no area too: the answer is then on one of the edges.
pub(crate) fn closest_point(p: &Point3<f32>, [a, b, c]: &[Point3<f32>; 3]) -> Point3<f32> {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return *a;
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    if d3 >= 0.0 && d4 <= d3 {
        return *b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * share(d1, d1 - d3);
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    if d6 >= 0.0 && d5 <= d6 {
        return *c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * share(d2, d2 - d6);
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return b + (c - b) * share(d4 - d3, (d4 - d3) + (d5 - d6));
    }
    let sum = va + vb + vc;
    a + ab * share(vb, sum) + ac * share(vc, sum)
}

fn share(part: f32, whole: f32) -> f32 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

/// Points spread over a triangle, no farther than about `spacing` apart; of a small one, its middle.
pub(crate) fn spread_points(
    [a, b, c]: &[Point3<f32>; 3],
    spacing: f32,
) -> impl Iterator<Item = Point3<f32>> + use<> {
    let (a, ab, ac) = (*a, b - a, c - a);
    let longest = ab.norm().max(ac.norm()).max((ac - ab).norm());
    let n = (longest / spacing).ceil().clamp(1.0, 100.0) as u16;
    let share = move |i: u16| (f32::from(i) + 1.0 / 3.0) / f32::from(n);
    (0..n).flat_map(move |i| (0..n - i).map(move |j| a + ab * share(i) + ac * share(j)))
}

/// Corners of every triangle of `mesh`.
pub(crate) fn corners(mesh: &TriangleMesh) -> Vec<[Point3<f32>; 3]> {
    let corner = |i: u32| mesh.vertices[i as usize];
    mesh.triangles.iter().map(|t| t.map(corner)).collect()
}

/// Twice the area times the unit normal.
pub(crate) fn area_normal([a, b, c]: &[Point3<f32>; 3]) -> Vector3<f32> {
    (b - a).cross(&(c - a))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use proptest::test_runner::{Config, RngSeed};

    fn config() -> Config {
        let rng_seed = RngSeed::Fixed(7);
        Config { rng_seed, failure_persistence: None, ..Config::default() }
    }

    fn point() -> impl Strategy<Value = Point3<f32>> {
        prop::array::uniform3(-1.0f32..1.0).prop_map(|[x, y, z]| Point3::new(x, y, z))
    }

    proptest! {
        #![proptest_config(config())]

        #[test]
        fn no_sampled_point_of_the_triangle_is_nearer(
            p in point(), triangle in prop::array::uniform3(point()),
        ) {
            let nearest = (closest_point(&p, &triangle) - p).norm();
            let [a, b, c] = triangle;
            for i in 0..=20 {
                for j in 0..=(20 - i) {
                    let (u, v) = (i as f32 / 20.0, j as f32 / 20.0);
                    let q = a + (b - a) * u + (c - a) * v;
                    prop_assert!(nearest <= (q - p).norm() + 1e-5);
                }
            }
        }

        #[test]
        fn the_nearest_point_is_of_the_triangle_even_of_one_without_area(
            p in point(), [a, b, c] in prop::array::uniform3(point()), flat in 0..4_usize,
        ) {
            let middle = nalgebra::center(&a, &b);
            let corners = [[a, b, c], [a, b, middle], [a, a, b], [a, a, a]][flat];
            let q = closest_point(&p, &corners).cast::<f64>();
            let [a, b, c] = corners.map(|corner| corner.cast::<f64>());
            // A point of the triangle parts it in three whose areas add up to its own.
            let area = |a: &Point3<f64>, b: &Point3<f64>, c: &Point3<f64>| {
                (b - a).cross(&(c - a)).norm()
            };
            let parts = area(&q, &a, &b) + area(&q, &b, &c) + area(&q, &c, &a);
            prop_assert!((parts - area(&a, &b, &c)).abs() < 1e-5);
            let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
            let farthest = (q - a).norm().max((q - b).norm()).max((q - c).norm());
            prop_assert!(farthest < longest + 1e-6);
        }
    }
}
