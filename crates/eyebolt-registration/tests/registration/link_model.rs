use crate::facets::Facets;
use crate::shapes::{cuboid, half_flipped, joined, moved, soup, star};
use crate::strategies::{config, isometry};
use eyebolt_registration::LinkModel;
use eyebolt_robot::TriangleMesh;
use nalgebra::{Isometry3, Point3, Vector3};
use proptest::prelude::*;

/// How far simplifying moves the surface at most, metres.
const SIMPLIFIED_M: f64 = 0.001;

fn sides() -> impl Strategy<Value = [f32; 3]> {
    [0.04..0.12_f32, 0.04..0.12_f32, 0.04..0.12_f32]
}

fn corners(mesh: &TriangleMesh) -> Vec<[Point3<f64>; 3]> {
    let corner = |i: u32| mesh.vertices[i as usize].cast();
    mesh.triangles.iter().map(|t| t.map(corner)).collect()
}

proptest! {
    #![proptest_config(config(6))]

    #[test]
    fn surface_points_are_on_the_box_and_face_outward(sides in sides(), pose in isometry(0.2)) {
        let model = LinkModel::build(&half_flipped(&moved(&cuboid(sides, [0.0; 3]), &pose)));
        for surface in &model.surface {
            let p = pose.inverse_transform_point(&surface.point.cast());
            let normal = pose.rotation.inverse() * surface.normal.cast::<f64>();
            let axis = normal.iamax();
            let apart = p[axis] * normal[axis].signum() - 0.5 * f64::from(sides[axis]);
            prop_assert!(normal[axis].abs() > 1.0 - 1e-5, "{normal:?}");
            prop_assert!(apart.abs() < 1e-6, "{apart}");
            let on_face = (0..3).all(|i| p[i].abs() < 0.5 * f64::from(sides[i]) + 1e-6);
            prop_assert!(on_face, "{p:?}");
        }
    }

    #[test]
    fn every_quarter_of_every_face_has_points_for_its_area(sides in sides()) {
        let model = LinkModel::build(&cuboid(sides, [0.0; 3]));
        let count = model.surface.len() as f64;
        prop_assert!((count - 800.0).abs() < 4.0, "{count} points");
        let [x, y, z] = sides;
        let area = |axis: usize| f64::from([y * z, z * x, x * y][axis]);
        let all: f64 = 2.0 * (0..3).map(area).sum::<f64>();
        for (axis, side) in (0..3).flat_map(|axis| [(axis, -1.0), (axis, 1.0)]) {
            let on_face: Vec<_> =
                model.surface.iter().filter(|s| s.normal[axis] * side > 0.5).collect();
            let share = on_face.len() as f64 / count;
            prop_assert!((share - area(axis) / all).abs() < 0.005, "{share} of {axis}");
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            for (su, sv) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                let quarter = |s: &&&_| -> bool {
                    let s: &eyebolt_registration::SurfacePoint = s;
                    s.point[u] * su > 0.0 && s.point[v] * sv > 0.0
                };
                let share = on_face.iter().filter(quarter).count() as f64 / count;
                prop_assert!((share - 0.25 * area(axis) / all).abs() < 0.01, "{share}");
            }
        }
    }

    #[test]
    fn what_is_drawn_stays_at_the_surface_and_faces_outward(
        size in 0.03..0.09_f32, bump in -0.3..0.3_f32, waves in 1.0..4.0_f32,
    ) {
        // Star-shaped about the origin: outward is where the origin is behind.
        let mesh = star(3, |d| size * (1.0 + bump * (waves * d.x + d.y).sin()));
        let model = LinkModel::build(&half_flipped(&mesh));
        let surface = Facets::of(&mesh);
        let drawn = Facets::of(&model.mesh);
        for [a, b, c] in corners(&model.mesh) {
            let middle = nalgebra::center(&nalgebra::center(&a, &b), &c);
            let away = surface.distance(&middle);
            prop_assert!(away < SIMPLIFIED_M, "{away}");
            prop_assert!((b - a).cross(&(c - a)).dot(&a.coords) > 0.0, "turned inward at {a:?}");
        }
        for vertex in &mesh.vertices {
            let away = drawn.distance(&vertex.cast());
            prop_assert!(away < SIMPLIFIED_M, "{away}");
        }
    }

    #[test]
    fn the_same_mesh_gives_the_same_model(sides in sides(), pose in isometry(0.2)) {
        let mesh = moved(&cuboid(sides, [0.0; 3]), &pose);
        prop_assert_eq!(LinkModel::build(&mesh), LinkModel::build(&mesh));
    }
}

#[test]
fn points_on_a_ball_are_spread_over_its_octants() {
    let model = LinkModel::build(&star(4, |_| 0.08));
    let mut counts = [0.0; 8];
    for surface in &model.surface {
        let p = surface.point;
        assert!((p.coords.norm() - 0.08).abs() < 3e-4, "{p:?}");
        assert!(surface.normal.dot(&p.coords.normalize()) > 0.99);
        let octant = (0..3).map(|axis| usize::from(p[axis] > 0.0) << axis).sum::<usize>();
        counts[octant] += 1.0;
    }
    let all: f64 = counts.iter().sum();
    for count in counts {
        assert!((count / all - 0.125).abs() < 0.005, "{counts:?}");
    }
}

#[test]
fn a_sheet_is_drawn_from_its_front() {
    let corner = |u: f32, v: f32| Vector3::new(0.1 * u, 0.1 * v, 0.0);
    let [a, b, c, d] = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
    let sheet = soup(&[[a, b, c], [a, c, d]]);
    let model = LinkModel::build(&moved(&sheet, &Isometry3::translation(0.01, 0.02, 0.031)));
    let up = |t: &&[Point3<f64>; 3]| (t[1] - t[0]).cross(&(t[2] - t[0])).z > 0.0;
    let drawn = corners(&model.mesh);
    assert_eq!(drawn.iter().filter(up).count(), 2, "{drawn:?}");
}

#[test]
fn parts_that_run_into_each_other_keep_what_can_be_seen_of_them() {
    // The middles of both triangles of each long side are covered.
    let beam = cuboid([0.04, 0.05, 0.3], [0.0; 3]);
    let block = cuboid([0.1, 0.1, 0.14], [0.0; 3]);
    let model = LinkModel::build(&joined(&[beam, block]));
    // All but what is within the block: 2 ends, 4 sides of 16 cm, the block without two holes.
    let ends = 2.0 * 0.04 * 0.05;
    let sides = 2.0 * (0.04 + 0.05) * 0.16;
    let body = 2.0 * (0.1 * 0.1 - 0.04 * 0.05) + 4.0 * 0.1 * 0.14;
    let share = |area: f64| area / (ends + sides + body);
    let count = model.surface.len() as f64;
    assert!((count - 800.0).abs() < 40.0, "{count} points");
    let beyond = model.surface.iter().filter(|s| s.point.z.abs() > 0.0705).count() as f64;
    assert!((beyond / count - share(ends + sides)).abs() < 0.03, "{beyond} of {count}");
    for surface in &model.surface {
        let p = surface.point;
        let in_block = p.x.abs() < 0.048 && p.y.abs() < 0.048 && p.z.abs() < 0.068;
        assert!(!in_block, "{p:?} is covered");
    }
    for [a, b, c] in corners(&model.mesh) {
        let outward = (b - a).cross(&(c - a)).dot(&(a.coords + b.coords + c.coords));
        assert!(outward > 0.0, "turned inward at {a:?}");
    }
    // Drawn whole: every side that can be seen is there, in full.
    let area = |t: [Point3<f64>; 3]| 0.5 * (t[1] - t[0]).cross(&(t[2] - t[0])).norm();
    let drawn: f64 = corners(&model.mesh).into_iter().map(area).sum();
    let whole = 2.0 * (0.04 * 0.05 + 0.05 * 0.3 + 0.3 * 0.04) + 2.0 * 0.01 + 4.0 * 0.014;
    assert!((drawn - whole).abs() < 1e-4, "{drawn} of {whole}");
}

#[test]
fn a_large_link_is_sampled_more_coarsely() {
    let box_mesh = cuboid([4.9, 4.9, 4.9], [0.0; 3]);
    let model = LinkModel::build_within(&box_mesh, 60_000);
    let field = &model.field;
    let points = field.size().iter().product::<usize>();
    assert!(points <= 60_000, "{points}");
    assert!(field.voxel_m() > 0.05);
    let at = |x: f32| field.sample(&nalgebra::Point3::new(x, 0.3, -0.2)).distance_m;
    assert!((at(2.5) - 0.05).abs() < 0.01, "{}", at(2.5));
    assert!(at(2.3) < -0.1, "inside");
}

#[test]
fn all_links_of_a_robot_keep_to_one_bound() {
    let of_an_arm = LinkModel::point_budget(8);
    assert_eq!(
        of_an_arm,
        LinkModel::point_budget(1),
        "an arm's links are sampled as finely as one"
    );
    for links in [17, 100, 255] {
        let all = links * LinkModel::point_budget(links);
        assert!(all <= 16 * of_an_arm && all > 15 * of_an_arm, "{links} links: {all}");
    }
}
