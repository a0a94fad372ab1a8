use crate::oracle::{facets, wrong};
use crate::scenes::{camera, config, eye, pose, rotation, scene, soup, sphere, triangles, vector};
use eyebolt_geometry::{Base, Camera, Distortion, Link, PinholeCamera, RayTable, Transform};
use eyebolt_render::{IdealView, PosedMesh, Raster, RayScene, SceneMesh};
use nalgebra::{Point2, Point3, UnitQuaternion, Vector3};
use proptest::prelude::*;

fn vga() -> PinholeCamera {
    PinholeCamera::new(161, 123, 150.0, 152.0, 79.3, 61.8, Distortion::None).unwrap()
}

/// The rays of all pixels, base frame, `None` where the lens has none.
fn rays<'a>(
    camera: &'a PinholeCamera,
    base_from_camera: &'a Transform<Base, Camera>,
) -> impl Iterator<Item = Option<Vector3<f64>>> + 'a {
    let pixels = (0..camera.height()).flat_map(|v| (0..camera.width()).map(move |u| (u, v)));
    pixels.map(|(u, v)| {
        let ray = camera.ray(&Point2::new(f64::from(u), f64::from(v)))?;
        Some(base_from_camera.direction(&ray))
    })
}

proptest! {
    #![proptest_config(config(48))]

    #[test]
    fn every_pixel_sees_what_trying_every_triangle_finds(
        meshes in triangles(), camera in camera(), base_from_camera in eye(),
    ) {
        let scene = scene(&meshes.iter().map(|mesh| soup(mesh)).collect::<Vec<_>>());
        let view = scene.view(&camera, &base_from_camera);
        prop_assert_eq!(view.width * view.height, camera.pixel_count());
        let (facets, origin) = (facets(&meshes), Point3::from(base_from_camera.translation_m()));
        for (at, ray) in rays(&camera, &base_from_camera).enumerate() {
            let (z, surface) = (f64::from(view.depth_m[at]), view.surface[at]);
            prop_assert_eq!(z > 0.0, surface != IdealView::NOTHING);
            let Some(ray) = ray else {
                prop_assert_eq!(z, 0.0);
                continue;
            };
            let seen = (z > 0.0).then_some((z, surface, None));
            let fault = wrong(&facets, (&origin, &ray), 6.0, seen);
            prop_assert!(fault.is_none(), "{at}: {}", fault.unwrap());
        }
    }

    #[test]
    fn normals_are_unit_and_face_the_camera(
        meshes in triangles(), camera in camera(), base_from_camera in eye(),
    ) {
        let scene = scene(&meshes.iter().map(|mesh| soup(mesh)).collect::<Vec<_>>());
        let view = scene.view(&camera, &base_from_camera);
        let camera_from_base = base_from_camera.inverse();
        for (at, ray) in rays(&camera, &base_from_camera).enumerate() {
            let normal = Vector3::from(view.normal_in_camera[at]).cast::<f64>();
            if view.surface[at] == IdealView::NOTHING {
                prop_assert_eq!(normal, Vector3::zeros());
                continue;
            }
            prop_assert!((normal.norm() - 1.0).abs() < 1e-6);
            prop_assert!(normal.dot(&camera_from_base.direction(&ray.unwrap())) <= 1e-6);
        }
    }

    #[test]
    fn threads_and_ways_to_ask_give_the_same_bytes(
        meshes in triangles(), camera in camera(), base_from_camera in eye(),
    ) {
        let meshes: Vec<_> = meshes.iter().map(|mesh| soup(mesh)).collect();
        let rays = RayTable::new(&camera);
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let scene = scene(&meshes);
                let view = scene.view(&camera, &base_from_camera);
                let mut depth_m = vec![f32::NAN; 17];
                scene.depth(&rays, &base_from_camera, &mut depth_m);
                assert_eq!(depth_m, view.depth_m);
                view
            })
        };
        prop_assert_eq!(on(1), on(2));
        prop_assert_eq!(on(1), on(3));
    }

    #[test]
    fn closed_meshes_look_as_they_are_drawn(
        poses in prop::collection::vec((vector(0.5), rotation()), 1..4), base_from_camera in eye(),
    ) {
        let camera = vga();
        let mesh = sphere(0.3, 12);
        let posed: Vec<(Transform<Camera, Link>, u8)> = poses
            .iter()
            .zip(0..)
            .map(|((at, turn), link)| (Transform::from_parts(at + Vector3::z() * 2.0, *turn), link))
            .collect();
        let mut raster = Raster::new(&camera);
        let drawn = posed.iter().map(|(camera_from_link, link)| PosedMesh {
            mesh: &mesh, camera_from_link: *camera_from_link, link: *link,
        });
        raster.draw(&camera, &drawn.collect::<Vec<_>>());
        let meshes = posed.iter().map(|(camera_from_link, _)| SceneMesh {
            mesh: &mesh, base_from_mesh: base_from_camera * *camera_from_link,
        });
        let view = RayScene::new(&meshes.collect::<Vec<_>>()).view(&camera, &base_from_camera);
        let same = |at: usize, other: usize| view.surface[at] == view.surface[other];
        for (u, v) in (1..view.width - 1).flat_map(|u| (1..view.height - 1).map(move |v| (u, v))) {
            let at = v * view.width + u;
            let inside = [at - 1, at + 1, at - view.width, at + view.width];
            if inside.into_iter().all(|other| same(at, other)) {
                let surface = raster.link(at).map_or(IdealView::NOTHING, u16::from);
                prop_assert_eq!(view.surface[at], surface);
                let z = raster.depth_m(at).unwrap_or(0.0);
                prop_assert!((view.depth_m[at] - z).abs() <= 1e-4 * z, "{} {z}", view.depth_m[at]);
            }
        }
    }

    #[test]
    fn a_sphere_is_where_its_equation_says(at in vector(0.3), pose in pose()) {
        let (camera, centre) = (vga(), at + Vector3::z() * 2.0);
        let base_from_mesh = pose * Transform::from_parts(centre, UnitQuaternion::identity());
        let base_from_camera = Transform::from_isometry(*pose.isometry());
        let (mesh, rings) = (sphere(0.5, 100), 100.0);
        let scene = RayScene::new(&[SceneMesh { mesh: &mesh, base_from_mesh }]);
        let view = scene.view(&camera, &base_from_camera);
        // How far the facets lie inside.
        let sag = 0.5 * (1.0 - (std::f64::consts::PI / rings).cos());
        for (at, ray) in RayTable::new(&camera).rays().iter().enumerate() {
            let ray = Vector3::new(f64::from(ray[0]), f64::from(ray[1]), 1.0);
            let middle = ray.dot(&centre) / ray.norm_squared();
            let beside = (ray * middle - centre).norm();
            if beside > 0.5 {
                prop_assert_eq!(view.depth_m[at], 0.0);
            } else if beside < 0.45 {
                let z = middle - ((0.25 - beside * beside) / ray.norm_squared()).sqrt();
                let behind = f64::from(view.depth_m[at]) - z;
                // At 64 degrees off the normal, a facet that lies inside is hit so much later.
                prop_assert!((-1e-6..2.0 * 2.5 * sag).contains(&behind), "{behind} {sag}");
                let normal = (ray * z - centre) / 0.5;
                let angle = normal.dot(&Vector3::from(view.normal_in_camera[at]).cast());
                prop_assert!(angle > 0.998, "{angle}");
            }
        }
    }
}

#[test]
fn a_wall_is_at_its_depth_from_both_sides() {
    let [a, b] = [Vector3::new(-9.0, -9.0, 2.0), Vector3::new(9.0, -9.0, 2.0)];
    let [c, d] = [Vector3::new(9.0, 9.0, 2.0), Vector3::new(-9.0, 9.0, 2.0)];
    for wall in [[[a, b, c], [a, c, d]], [[a, c, b], [a, d, c]]] {
        let view = scene(&[soup(&wall)]).view(&vga(), &Transform::identity());
        for at in 0..view.depth_m.len() {
            assert!((view.depth_m[at] - 2.0).abs() < 1e-6);
            assert_eq!(view.surface[at], 0);
            assert_eq!(view.normal_in_camera[at], [0.0, 0.0, -1.0]);
        }
    }
}
