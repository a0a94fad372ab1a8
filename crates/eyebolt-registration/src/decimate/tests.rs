use super::simplified;
use crate::triangle::closest_point;
use eyebolt_robot::TriangleMesh;
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

const TOLERANCE_M: f32 = 0.0004;

/// The same cases every time, and no files of failures.
fn config(cases: u32) -> Config {
    Config { cases, rng_seed: RngSeed::Fixed(7), failure_persistence: None, ..Config::default() }
}

/// A mesh of the triangles, each with its own corners.
fn soup(triangles: &[[Vector3<f32>; 3]]) -> TriangleMesh {
    let vertices = triangles.iter().flatten().map(|v| Point3::from(*v)).collect();
    let triangles = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    TriangleMesh { vertices, triangles }
}

/// An icosahedron, each side cut into `cuts` by `cuts`, on the sphere of `radius`.
fn icosphere(radius: f32, cuts: usize) -> TriangleMesh {
    let golden = f32::midpoint(1.0, 5f32.sqrt());
    let mut corners = Vec::new();
    for (s, t) in [(1.0, golden), (1.0, -golden), (-1.0, golden), (-1.0, -golden)] {
        let corner = Vector3::new(0.0, s, t);
        corners.extend([corner, Vector3::new(t, 0.0, s), Vector3::new(s, t, 0.0)]);
    }
    let near = |a: &Vector3<f32>, b: &Vector3<f32>| ((a - b).norm() - 2.0).abs() < 1e-4;
    let mut triangles = Vec::new();
    for (i, a) in corners.iter().enumerate() {
        for (j, b) in corners.iter().enumerate().skip(i + 1) {
            for c in corners.iter().skip(j + 1).filter(|c| near(a, b) && near(a, c) && near(b, c)) {
                let outward = (b - a).cross(&(c - a)).dot(a) > 0.0;
                let side = if outward { [*a, *b, *c] } else { [*a, *c, *b] };
                triangles.extend(cut(&side, cuts));
            }
        }
    }
    let placed: Vec<_> = triangles.iter().map(|t| t.map(|v| v.normalize() * radius)).collect();
    soup(&placed)
}

/// The triangle in `cuts` by `cuts` equal ones.
fn cut([a, b, c]: &[Vector3<f32>; 3], cuts: usize) -> Vec<[Vector3<f32>; 3]> {
    // Corners that sides share must come out the same from both: summed in the order of size.
    let at = |i: usize, j: usize| {
        let k = cuts - i - j;
        let mut parts = [(k, a), (i, b), (j, c)];
        parts.sort_by(|(_, u), (_, v)| u.as_slice().partial_cmp(v.as_slice()).unwrap());
        parts.iter().map(|(part, v)| *v * *part as f32).sum::<Vector3<f32>>()
    };
    let mut pieces = Vec::new();
    for (i, j) in (0..cuts).flat_map(|i| (0..cuts - i).map(move |j| (i, j))) {
        pieces.push([at(i, j), at(i + 1, j), at(i, j + 1)]);
        if i + j + 2 <= cuts {
            pieces.push([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    pieces
}

/// `place` of the unit square in `cells` by `cells` pairs of triangles.
fn sheet(cells: u32, place: impl Fn(f32, f32) -> Vector3<f32>) -> Vec<[Vector3<f32>; 3]> {
    let at = |i: u32, j: u32| place(i as f32 / cells as f32, j as f32 / cells as f32);
    let cell = |(i, j)| {
        let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        [[a, b, c], [a, c, d]]
    };
    (0..cells).flat_map(|i| (0..cells).map(move |j| (i, j))).flat_map(cell).collect()
}

/// A box from zero to `size`, each side of `cells` by `cells` pairs of triangles.
fn cuboid(size: Vector3<f32>, cells: u32) -> TriangleMesh {
    let side = |axis: usize, top: bool| {
        sheet(cells, move |u, v| {
            let mut p = Vector3::zeros();
            p[axis] = f32::from(u8::from(top));
            let (first, second) = if top { (1, 2) } else { (2, 1) };
            p[(axis + first) % 3] = u;
            p[(axis + second) % 3] = v;
            p.component_mul(&size)
        })
    };
    let sides = (0..3).flat_map(|axis| [side(axis, false), side(axis, true)]);
    soup(&sides.flatten().collect::<Vec<_>>())
}

fn corners(mesh: &TriangleMesh) -> Vec<[Point3<f32>; 3]> {
    mesh.triangles.iter().map(|t| t.map(|i| mesh.vertices[i as usize])).collect()
}

fn distance(p: &Point3<f32>, triangles: &[[Point3<f32>; 3]]) -> f32 {
    triangles.iter().map(|t| (closest_point(p, t) - p).norm()).fold(f32::INFINITY, f32::min)
}

/// The farthest that a first corner or the middle of a triangle of `from` is from `to`.
fn farthest(from: &TriangleMesh, to: &TriangleMesh) -> f32 {
    let to = corners(to);
    let middle = |[a, b, c]: [Point3<f32>; 3]| Point3::from((a.coords + b.coords + c.coords) / 3.0);
    let points = corners(from).into_iter().flat_map(|t| [t[0], middle(t)]);
    points.map(|p| distance(&p, &to)).fold(0.0, f32::max)
}

fn volume(mesh: &TriangleMesh) -> f64 {
    let cone = |t: [Point3<f32>; 3]| {
        let [a, b, c] = t.map(|corner| corner.coords.cast::<f64>());
        a.dot(&b.cross(&c)) / 6.0
    };
    corners(mesh).into_iter().map(cone).sum()
}

/// How many edges have not two triangles, one along and one against them.
fn open_edges(mesh: &TriangleMesh) -> usize {
    let mut edges: Vec<([u32; 2], bool)> = Vec::new();
    for [a, b, c] in &mesh.triangles {
        for [u, v] in [[*a, *b], [*b, *c], [*c, *a]] {
            edges.push(([u.min(v), u.max(v)], u < v));
        }
    }
    edges.sort_unstable();
    let is_closed = |edge: &[([u32; 2], bool)]| matches!(edge, [(_, false), (_, true)]);
    edges.chunk_by(|a, b| a.0 == b.0).filter(|edge| !is_closed(edge)).count()
}

#[test]
fn a_sphere_stays_round_and_loses_most_triangles() {
    let radius = 0.06;
    let sphere = icosphere(radius, 32);
    assert_eq!(sphere.triangles.len(), 20_480);
    let few = simplified(&sphere, TOLERANCE_M);
    assert!(few.triangles.len() < sphere.triangles.len() / 5, "{}", few.triangles.len());
    assert_eq!(open_edges(&few), 0);
    for vertex in &few.vertices {
        let away = vertex.coords.norm() - radius;
        assert!(away.abs() < 2.0 * TOLERANCE_M, "{away}");
    }
    let away = farthest(&sphere, &few);
    assert!(away < 3.0 * TOLERANCE_M, "{away}");
    let share = volume(&few) / volume(&sphere);
    assert!((share - 1.0).abs() < 0.005, "{share}");
}

#[test]
fn a_box_becomes_a_dozen_triangles_with_its_corners() {
    let size = Vector3::new(0.08, 0.12, 0.2);
    let mesh = cuboid(size, 30);
    let few = simplified(&mesh, TOLERANCE_M);
    assert!(few.triangles.len() <= 20, "{} triangles", few.triangles.len());
    assert_eq!(open_edges(&few), 0);
    for bits in 0..8 {
        let side = |axis: usize| if bits >> axis & 1 == 0 { 0.0 } else { size[axis] };
        let corner = Point3::new(side(0), side(1), side(2));
        let away = few.vertices.iter().map(|v| (v - corner).norm()).fold(f32::INFINITY, f32::min);
        assert!(away < 1e-4, "{away} from {corner}");
    }
    assert!((volume(&few) / volume(&mesh) - 1.0).abs() < 1e-3);
}

#[test]
fn an_open_sheet_keeps_its_border() {
    let square = |u, v| Vector3::new(0.1 * u, 0.1 * v, 0.02);
    let mesh = soup(&sheet(40, square));
    let few = simplified(&mesh, TOLERANCE_M);
    assert!(few.triangles.len() <= 8, "{} triangles", few.triangles.len());
    let away = farthest(&mesh, &few);
    assert!(away < 1e-4, "{away}");
    let area: f32 = corners(&few).iter().map(|t| crate::triangle::area_normal(t).z / 2.0).sum();
    assert!((area - 0.01).abs() < 1e-5, "{area}");
}

#[test]
fn a_seam_of_three_sheets_stays() {
    let leaf = |turn: f32| {
        let (sin, cos) = turn.sin_cos();
        sheet(20, move |u, v| Vector3::new(0.1 * u * cos, 0.1 * u * sin, 0.1 * v))
    };
    let mesh = soup(&[leaf(0.0), leaf(2.0), leaf(4.0)].concat());
    let few = simplified(&mesh, TOLERANCE_M);
    assert!(few.triangles.len() < 30, "{} triangles", few.triangles.len());
    let away = farthest(&mesh, &few).max(farthest(&few, &mesh));
    assert!(away < 1e-4, "{away}");
}

/// In the mean over a wide sheet a knob vanishes.
#[test]
fn a_knob_on_a_wide_sheet_stays() {
    let bump = |x: f32| (1.0 - x * x / 1e-5).max(0.0);
    let height = |u: f32, v: f32| 0.003 * bump(0.1 * u - 0.05) * bump(0.1 * v - 0.05);
    let mesh = soup(&sheet(100, |u, v| Vector3::new(0.1 * u, 0.1 * v, height(u, v))));
    let few = simplified(&mesh, TOLERANCE_M);
    assert!(few.triangles.len() < mesh.triangles.len() / 20, "{}", few.triangles.len());
    let away = farthest(&mesh, &few);
    assert!(away < 3.0 * TOLERANCE_M, "{away}");
}

/// Its rings of three edges are no triangles: to collapse one would tie the needle off.
#[test]
fn a_needle_thinner_than_the_tolerance_is_not_tied_off() {
    let around = |turn: u32| {
        let (sin, cos) = (turn as f32 * std::f32::consts::TAU / 3.0).sin_cos();
        Vector3::new(0.0002 * cos, 0.0002 * sin, 0.0)
    };
    let ring =
        |height: u32| [0, 1, 2].map(|turn| around(turn) + Vector3::z() * (0.001 * height as f32));
    let mut triangles = vec![[ring(0)[0], ring(0)[2], ring(0)[1]], ring(50)];
    for (height, side) in (0..50).flat_map(|height| (0..3).map(move |side| (height, side))) {
        let (low, high, next) = (ring(height), ring(height + 1), (side + 1) % 3);
        triangles.push([low[side], low[next], high[next]]);
        triangles.push([low[side], high[next], high[side]]);
    }
    let needle = soup(&triangles);
    let few = simplified(&needle, TOLERANCE_M);
    assert!((4..40).contains(&few.triangles.len()), "{} triangles", few.triangles.len());
    assert_eq!(open_edges(&few), 0);
    assert!(farthest(&needle, &few) < 2.0 * TOLERANCE_M);
}

#[test]
fn what_has_no_surface_gives_none() {
    let point = Point3::new(0.1, 0.2, 0.3);
    let all_equal =
        TriangleMesh { vertices: vec![point; 6], triangles: vec![[0, 1, 2], [3, 4, 5]] };
    let line = [0.0, 0.25, 0.5, 1.0].map(|x| Vector3::new(x, 0.0, 0.0));
    let lines = soup(&[[line[0], line[1], line[2]], [line[1], line[2], line[3]]]);
    for mesh in [TriangleMesh::default(), all_equal, lines] {
        assert_eq!(simplified(&mesh, TOLERANCE_M), TriangleMesh::default());
    }
}

#[test]
fn one_triangle_stays_and_its_copies_go() {
    let [a, b, c] = [Vector3::zeros(), Vector3::new(0.1, 0.0, 0.0), Vector3::new(0.0, 0.1, 0.0)];
    let minus_zeros = [-a, Vector3::new(0.1, -0.0, 0.0), c];
    let few = simplified(&soup(&[[a, b, c], [b, c, a], [a, c, b], minus_zeros]), TOLERANCE_M);
    assert_eq!(few, soup(&[[a, b, c]]));
}

/// Points on a coarse grid, so that many are equal, in line or in a plane.
fn any_soup() -> impl Strategy<Value = TriangleMesh> {
    let point = prop::array::uniform3(-3i8..=3).prop_map(|p| p.map(|x| f32::from(x) * 0.0005));
    (prop::collection::vec(point, 1..40), prop::collection::vec(any::<[u32; 3]>(), 0..120))
        .prop_map(|(points, corners)| {
            let count = points.len() as u32;
            let triangles = corners.iter().map(|t| t.map(|corner| corner % count)).collect();
            TriangleMesh { vertices: points.into_iter().map(Point3::from).collect(), triangles }
        })
}

proptest! {
    #![proptest_config(config(200))]

    #[test]
    fn any_soup_gives_a_sound_mesh_twice_the_same(mesh in any_soup()) {
        let few = simplified(&mesh, TOLERANCE_M);
        prop_assert_eq!(&few, &simplified(&mesh, TOLERANCE_M));
        prop_assert!(few.triangles.len() <= mesh.triangles.len());
        let mut used = few.triangles.concat();
        used.sort_unstable();
        used.dedup();
        prop_assert_eq!(used, (0..few.vertices.len() as u32).collect::<Vec<_>>());
        for [a, b, c] in corners(&few).into_iter().map(|t| t.map(|corner| corner.cast::<f64>())) {
            prop_assert!((b - a).cross(&(c - a)).norm() > 1e-12);
        }
    }
}

proptest! {
    #![proptest_config(config(6))]

    #[test]
    fn a_closed_lump_stays_closed_and_keeps_its_volume(
        size in 0.04..0.09_f32, bump in -0.3..0.3_f32, waves in 1.0..4.0_f32,
    ) {
        let mut mesh = icosphere(1.0, 12);
        for vertex in &mut mesh.vertices {
            let d = vertex.coords;
            *vertex = Point3::from(d * size * (1.0 + bump * (waves * d.x + d.y).sin()));
        }
        let few = simplified(&mesh, TOLERANCE_M);
        prop_assert_eq!(open_edges(&few), 0);
        prop_assert!(few.triangles.len() < mesh.triangles.len() / 3, "{}", few.triangles.len());
        let away = farthest(&mesh, &few).max(farthest(&few, &mesh));
        prop_assert!(away < 3.0 * TOLERANCE_M, "{}", away);
        let share = volume(&few) / volume(&mesh);
        prop_assert!((share - 1.0).abs() < 0.005, "{}", share);
    }

    #[test]
    fn seeing_the_mesh_from_another_corner_of_the_room_changes_little(turn in 0.0..6.0_f32) {
        let mesh = cuboid(Vector3::new(0.05, 0.06, 0.07), 12);
        let rotation = nalgebra::Rotation3::new(Vector3::new(0.3, 0.5, 1.0).normalize() * turn);
        let mut turned = mesh.clone();
        turned.vertices.iter_mut().for_each(|vertex| *vertex = rotation * *vertex);
        let few = simplified(&turned, TOLERANCE_M);
        // Rounding makes the flat sides rough by a ten-millionth.
        prop_assert!(few.triangles.len() <= 20, "{}", few.triangles.len());
        prop_assert!(farthest(&turned, &few) < 1e-4);
    }
}
