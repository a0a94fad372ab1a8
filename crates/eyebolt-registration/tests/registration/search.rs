use crate::strategies::{config, on_threads};
use crate::synthetic_arm::{ARM, POSTURES, Scene, looking, scenes};
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::{Candidate, Posture, SearchView, SurfacePoint, search};
use nalgebra::Vector3;
use proptest::prelude::*;

/// The whole arm's surface in one configuration, base frame.
fn surface(posture: &Posture) -> Vec<SurfacePoint> {
    let links = ARM.links().iter().zip(posture.base_from_link());
    let points = links.flat_map(|(link, pose)| {
        link.model.surface.iter().map(|s| SurfacePoint {
            point: pose.point(&s.point.cast()).cast(),
            normal: pose.direction(&s.normal.cast()).cast(),
        })
    });
    points.collect()
}

fn views(scenes: &[Scene]) -> Vec<SearchView<'_>> {
    let view = |scene| {
        let scene: &Scene = scene;
        SearchView {
            view: scene.view(),
            arm_points: scene.points(2, 2),
            surface: surface(scene.posture),
        }
    };
    scenes.iter().map(view).collect()
}

/// Cameras 1.1 to 1.5 m from the arm on any side, up to upside down.
fn truth() -> impl Strategy<Value = Transform<Camera, Base>> {
    let at = (-0.1..0.1_f64, -0.1..0.1_f64, 0.3..0.45_f64);
    (0.0..6.3_f64, -0.2..1.0_f64, 1.1..1.5_f64, -3.1..3.1_f64, at).prop_map(
        |(azimuth, elevation, distance, roll, (x, y, z))| {
            let at = Vector3::new(x, y, z);
            let (across, up) = (elevation.cos(), elevation.sin());
            let from = Vector3::new(across * azimuth.cos(), across * azimuth.sin(), up);
            looking(at + from * distance, at, roll)
        },
    )
}

/// Metres between the cameras in the base frame, and degrees.
fn error(truth: &Transform<Camera, Base>, found: &Candidate) -> (f64, f64) {
    let (metres, _) = truth.inverse().distance_to(&found.camera_from_base.inverse());
    let (origin_m, radians) = truth.distance_to(&found.camera_from_base);
    (metres.min(origin_m), radians.to_degrees())
}

proptest! {
    #![proptest_config(config(12))]

    #[test]
    fn the_best_candidate_is_near_the_truth(truth in truth()) {
        let scenes = scenes(&truth, None);
        let found = search(&ARM, &views(&scenes), 1, 3);
        let (metres, degrees) = error(&truth, &found[0]);
        prop_assert!(metres < 0.05 && degrees < 10.0, "{metres} m, {degrees} degrees");
        prop_assert!(found.is_sorted_by(|a, b| a.score() <= b.score()));
        for (i, a) in found.iter().enumerate() {
            for b in &found[..i] {
                let (metres, radians) = a.camera_from_base.distance_to(&b.camera_from_base);
                prop_assert!(metres >= 0.1 || radians >= 10f64.to_radians());
            }
        }
    }
}

#[test]
fn one_thread_or_two_give_the_same_bytes() {
    let truth = looking(Vector3::new(0.9, -0.8, 0.9), Vector3::new(0.0, 0.0, 0.4), 2.0);
    let scenes = scenes(&truth, None);
    let views = views(&scenes);
    let found = [1, 2].map(|threads| {
        let found = on_threads(threads, || search(&ARM, &views, 5, 6));
        let bits = |c: &Candidate| -> Vec<u64> {
            let matrix = c.camera_from_base.matrix();
            let scores = [c.distance_m, c.contradicted];
            matrix.iter().chain(&scores).map(|number| number.to_bits()).collect()
        };
        assert_eq!(found.len(), 6);
        found.iter().map(bits).collect::<Vec<_>>()
    });
    assert_eq!(found[0], found[1]);
}

#[test]
fn no_views_or_empty_views_give_no_candidates() {
    assert!(search(&ARM, &[], 1, 3).is_empty());
    let truth = looking(Vector3::new(1.2, 0.0, 0.6), Vector3::new(0.0, 0.0, 0.4), 0.0);
    let scenes = scenes(&truth, None);
    let mut without_points = views(&scenes);
    without_points[2].arm_points.clear();
    assert!(search(&ARM, &without_points, 1, 3).is_empty());
    let mut without_surface = views(&scenes);
    without_surface[0].surface.clear();
    assert!(search(&ARM, &without_surface, 1, 3).is_empty());
    assert!(search(&ARM, &views(&scenes)[..1], 1, 0).is_empty());
    assert_eq!(POSTURES.len(), scenes.len());
}
