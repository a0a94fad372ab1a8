use crate::oracle::{facets, meet};
use crate::scenes::{config, eye, pose, scene, soup, sphere, triangles, vector};
use eyebolt_geometry::{Distortion, PinholeCamera, RayTable};
use eyebolt_render::{RayScene, SceneMesh};
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

proptest! {
    #![proptest_config(config(128))]

    #[test]
    fn seen_is_what_no_triangle_hides(
        meshes in triangles(), from in vector(2.0),
        points in prop::collection::vec(vector(2.0), 0..200),
    ) {
        let scene = scene(&meshes.iter().map(|mesh| soup(mesh)).collect::<Vec<_>>());
        let from = Point3::from(from);
        let points: Vec<Point3<f32>> = points.iter().map(|p| Point3::from(*p).cast()).collect();
        let facets = facets(&meshes);
        let visible = scene.visible_from(from, &points);
        prop_assert_eq!(visible.len(), points.len());
        for (point, visible) in points.iter().zip(visible) {
            let ray = point.cast::<f64>() - from;
            let mut meetings = facets.iter().map(|facet| meet(facet, &from, &ray, 6.0));
            if visible {
                // Nothing is surely before the point, but for its own surface.
                let hides = meetings.any(|m| m.certain() && m.t[2] < 1.0 - 6e-4);
                prop_assert!(!hides, "{point} is hidden");
            } else {
                let hides = meetings.any(|m| m.possible() && m.t[1] < 1.0 - 4e-4);
                prop_assert!(hides, "{point} is not hidden");
            }
        }
    }

    #[test]
    fn a_ray_to_the_point_says_the_same(
        pose in pose(), from in vector(2.0), points in prop::collection::vec(vector(1.5), 1..100),
    ) {
        let mesh = sphere(0.5, 10);
        let scene = RayScene::new(&[SceneMesh { mesh: &mesh, base_from_mesh: pose }]);
        let from = Point3::from(from);
        let points: Vec<Point3<f32>> = points.iter().map(|p| Point3::from(*p).cast()).collect();
        for (point, visible) in points.iter().zip(scene.visible_from(from, &points)) {
            let ray = point.cast::<f64>() - from;
            let hit = scene.nearest(&from, &ray).map(|hit| hit.distance_m / ray.norm());
            let hidden = hit.is_some_and(|share| share < 1.0 - 5e-4);
            prop_assert_eq!(visible, !hidden, "{} {:?}", point, hit);
        }
    }

    #[test]
    fn what_a_camera_sees_is_seen_from_there(meshes in triangles(), base_from_camera in eye()) {
        let scene = scene(&meshes.iter().map(|mesh| soup(mesh)).collect::<Vec<_>>());
        let camera = PinholeCamera::new(64, 48, 50.0, 50.0, 32.0, 24.0, Distortion::None).unwrap();
        let (view, rays) = (scene.view(&camera, &base_from_camera), RayTable::new(&camera));
        let point = |at: usize| rays.point(at, view.depth_m[at]).cast::<f64>();
        // A surface that is seen edge-on, within half a degree, has no depth to speak of.
        let faces = |at: &usize| {
            let normal = Vector3::from(view.normal_in_camera[*at]).cast();
            normal.dot(&point(*at).coords) < -0.01 * point(*at).coords.norm()
        };
        let seen = (0..view.depth_m.len()).filter(|at| view.depth_m[*at] > 0.0).filter(faces);
        let point = |at: usize| base_from_camera.point(&point(at)).cast();
        let points: Vec<Point3<f32>> = seen.map(point).collect();
        let visible = scene.visible_from(Point3::from(base_from_camera.translation_m()), &points);
        // A ray that just misses an edge may just hit it when it is rounded again.
        let hidden = visible.iter().filter(|visible| !**visible).count();
        prop_assert!(hidden <= points.len() / 500, "{hidden} of {}", points.len());
    }
}

#[test]
fn points_that_are_none_are_not_seen() {
    let scene = scene(&[soup(&[])]);
    let nowhere = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    let mut points: Vec<_> = nowhere.map(|x| Point3::new(x, 0.0, 1.0)).to_vec();
    points.extend([Point3::new(0.0, 0.0, 1.0), Point3::origin()]);
    assert_eq!(scene.visible_from(Point3::origin(), &points), [false, false, false, true, true]);
    assert_eq!(scene.visible_from(Point3::origin(), &points[..3]), [false; 3]);
    assert!(scene.visible_from(Point3::origin(), &[]).is_empty());
}
