use crate::oracle::{facets, wrong};
use crate::scenes::{config, ray, scene, soup, triangle, triangles};
use eyebolt_render::RayScene;
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

type Ray = (Point3<f64>, Vector3<f64>);

/// Why what is hit of the triangles, times `scale`, cannot be.
fn fault(
    meshes: &[Vec<[Vector3<f32>; 3]>],
    scale: f32,
    (origin, direction): &Ray,
) -> Option<String> {
    let scaled = |mesh: &Vec<[Vector3<f32>; 3]>| {
        mesh.iter().map(|t| t.map(|corner| corner * scale)).collect::<Vec<_>>()
    };
    let meshes: Vec<_> = meshes.iter().map(scaled).collect();
    let scene = scene(&meshes.iter().map(|mesh| soup(mesh)).collect::<Vec<_>>());
    let scale = f64::from(scale);
    let origin = origin * scale;
    let seen = scene.nearest(&origin, direction);
    let multiple = |distance_m: f64| distance_m / direction.norm();
    let seen = seen.map(|hit| (multiple(hit.distance_m), hit.surface, Some(hit.triangle)));
    wrong(&facets(&meshes), (&origin, direction), 6.0 * scale, seen)
}

proptest! {
    #![proptest_config(config(512))]

    #[test]
    fn what_is_hit_is_what_trying_every_triangle_finds(
        meshes in triangles(), rays in prop::collection::vec(ray(), 20),
    ) {
        for ray in &rays {
            let fault = fault(&meshes, 1.0, ray);
            prop_assert!(fault.is_none(), "{ray:?}: {}", fault.unwrap());
        }
    }

    #[test]
    fn one_triangle(only in triangle(), rays in prop::collection::vec(ray(), 20)) {
        for ray in &rays {
            let fault = fault(&[vec![only]], 1.0, ray);
            prop_assert!(fault.is_none(), "{ray:?}: {}", fault.unwrap());
        }
    }

    #[test]
    fn at_any_scale(meshes in triangles(), exponent in -30..30_i32, ray in ray()) {
        let fault = fault(&meshes, 10_f32.powi(exponent), &ray);
        prop_assert!(fault.is_none(), "{}", fault.unwrap());
    }

    #[test]
    fn rays_to_corners_and_along_edges(
        meshes in triangles(), which in any::<prop::sample::Index>(), share in 0.0..1.0_f64,
        from in ray(),
    ) {
        let all: Vec<_> = meshes.iter().flatten().collect();
        if all.is_empty() {
            return Ok(());
        }
        let [a, b, _] = all[which.index(all.len())].map(|corner| corner.cast::<f64>());
        let onto = a + (b - a) * share;
        let origin = from.0;
        let to = |target: Vector3<f64>| (origin, target - origin.coords);
        for ray in [to(a), to(onto), (origin, b - a), (Point3::from(onto), b - a)] {
            let fault = (ray.1.norm() > 1e-6).then(|| fault(&meshes, 1.0, &ray)).flatten();
            prop_assert!(fault.is_none(), "{}", fault.unwrap());
        }
    }

    #[test]
    fn corners_that_are_not_finite_hide_their_triangle_only(
        mut meshes in triangles(), rays in prop::collection::vec(ray(), 5),
        bad in prop::collection::vec((any::<prop::sample::Index>(), 0..3_usize, 0..3_usize, 0..3_usize), 1..6),
    ) {
        let count: usize = meshes.iter().map(Vec::len).sum();
        for (which, corner, axis, value) in bad.into_iter().filter(|_| count > 0) {
            let triangle = meshes.iter_mut().flatten().nth(which.index(count)).unwrap();
            triangle[corner][axis] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY][value];
        }
        for ray in &rays {
            let fault = fault(&meshes, 1.0, ray);
            prop_assert!(fault.is_none(), "{}", fault.unwrap());
        }
    }

    #[test]
    fn normals_are_unit_and_face_the_ray(meshes in triangles(), ray in ray()) {
        let scene = scene(&meshes.iter().map(|mesh| soup(mesh)).collect::<Vec<_>>());
        if let Some(hit) = scene.nearest(&ray.0, &ray.1) {
            prop_assert!((hit.normal_in_base.norm() - 1.0).abs() < 1e-12);
            prop_assert!(hit.normal_in_base.dot(&ray.1) <= 0.0);
            let [a, b, c] = meshes[hit.surface as usize][hit.triangle as usize].map(|c| c.cast::<f64>());
            let normal = (b - a).cross(&(c - a));
            // Slivers are turned by what rounding moves their corners.
            if normal.norm() > 1e-3 {
                prop_assert!(normal.normalize().cross(&hit.normal_in_base).norm() < 1e-3);
            }
        }
    }
}

#[test]
fn an_empty_scene_is_empty() {
    let z = Vector3::z();
    for scene in [RayScene::new(&[]), scene(&[soup(&[])])] {
        assert_eq!(scene.nearest(&Point3::origin(), &z), None);
        assert_eq!(scene.visible_from(Point3::origin(), &[Point3::new(0.0, 1.0, 2.0)]), [true]);
    }
}

#[test]
fn a_ray_without_a_direction_hits_nothing() {
    let wall =
        [Vector3::new(-1.0, -1.0, 1.0), Vector3::new(1.0, -1.0, 1.0), Vector3::new(0.0, 1.0, 1.0)];
    let scene = scene(&[soup(&[wall])]);
    assert!(scene.nearest(&Point3::origin(), &Vector3::z()).is_some());
    for direction in
        [Vector3::zeros(), Vector3::repeat(f64::NAN), Vector3::new(0.0, 0.0, f64::INFINITY)]
    {
        assert_eq!(scene.nearest(&Point3::origin(), &direction), None);
    }
    for origin in [f64::NAN, f64::INFINITY, 1e300] {
        assert_eq!(scene.nearest(&Point3::new(origin, 0.0, 0.0), &Vector3::z()), None);
    }
}
