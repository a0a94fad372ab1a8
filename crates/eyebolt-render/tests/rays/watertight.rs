//! No ray passes between triangles with a common edge.

use crate::scenes::{config, pose, rotation, sphere, vector};
use eyebolt_geometry::{Base, Camera, Distortion, PinholeCamera, Transform};
use eyebolt_render::{RayScene, SceneMesh};
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

/// Corners, middles of edges, other points of edges, and middles of triangles.
fn targets(mesh: &eyebolt_robot::TriangleMesh, share: f64) -> Vec<Point3<f64>> {
    let mut targets: Vec<Point3<f64>> = mesh.vertices.iter().map(|v| v.cast()).collect();
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|i| mesh.vertices[i as usize].cast::<f64>());
        targets.extend([(a, b), (b, c), (c, a)].map(|(p, q)| p + (q - p) * 0.5));
        targets.extend([(a, b), (b, c), (c, a)].map(|(p, q)| p + (q - p) * share));
        targets.push(Point3::from((a.coords + b.coords + c.coords) / 3.0));
    }
    targets
}

proptest! {
    #![proptest_config(config(16))]

    #[test]
    fn every_ray_from_within_a_sphere_hits_it(
        pose in pose(), inside in vector(0.4), share in 0.0..1.0_f64, rings in 2..16_u32,
    ) {
        let mesh = sphere(1.0, rings);
        // Chords of a coarse sphere leave less room.
        let origin = pose.point(&Point3::from(inside * 0.7));
        let scene = RayScene::new(&[SceneMesh { mesh: &mesh, base_from_mesh: pose }]);
        for target in targets(&mesh, share) {
            let direction = pose.point(&target) - origin;
            let hit = scene.nearest(&origin, &direction);
            prop_assert!(hit.is_some(), "to {target}");
            prop_assert!((hit.unwrap().distance_m - direction.norm()).abs() < 1e-5);
        }
    }

    #[test]
    fn every_ray_through_a_sphere_hits_it(
        pose in pose(), outside in vector(1.0), share in 0.0..1.0_f64, rings in 4..16_u32,
    ) {
        prop_assume!(outside.norm() > 0.1);
        let mesh = sphere(1.0, rings);
        let scene = RayScene::new(&[SceneMesh { mesh: &mesh, base_from_mesh: pose }]);
        let origin = pose.point(&Point3::from(outside.normalize() * 3.0));
        for target in targets(&mesh, share) {
            // Surely inside when shrunk a little, and the ray crosses near the same edges.
            let direction = pose.point(&(target * 0.999)) - origin;
            prop_assert!(scene.nearest(&origin, &direction).is_some(), "to {target}");
        }
    }

    #[test]
    fn every_pixel_sees_the_sphere_around_it(
        pose in pose(), turn in rotation(), inside in vector(0.3), rings in 3..40_u32,
    ) {
        let mesh = sphere(1.0, rings);
        let scene = RayScene::new(&[SceneMesh { mesh: &mesh, base_from_mesh: pose }]);
        let camera = PinholeCamera::new(160, 120, 80.0, 80.0, 80.0, 60.0, Distortion::None).unwrap();
        let origin = pose.point(&Point3::from(inside));
        let base_from_camera: Transform<Base, Camera> = Transform::from_parts(origin.coords, turn);
        let view = scene.view(&camera, &base_from_camera);
        prop_assert!(view.depth_m.iter().all(|z| *z > 0.0));
    }
}

#[test]
fn rays_exactly_through_the_edges_of_a_grid() {
    // Corners and pixels on the same lattice: all rays go through edges or corners.
    let mut triangles = Vec::new();
    let corner = |i: i32, j: i32| Vector3::new(i as f32, j as f32, 8.0);
    for (i, j) in (-8..8).flat_map(|i| (-8..8).map(move |j| (i, j))) {
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    let mesh = crate::scenes::soup(&triangles);
    let scene = crate::scenes::scene(&[mesh]);
    let camera = PinholeCamera::new(33, 33, 16.0, 16.0, 16.0, 16.0, Distortion::None).unwrap();
    let view = scene.view(&camera, &Transform::identity());
    let seen = |u: usize, v: usize| view.depth_m[v * 33 + u];
    for (u, v) in (0..33).flat_map(|u| (0..33).map(move |v| (u, v))) {
        assert_eq!(seen(u, v), 8.0, "{u} {v}");
    }
}
