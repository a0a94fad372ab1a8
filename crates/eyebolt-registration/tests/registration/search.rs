use crate::strategies::{config, on_threads};
use crate::synthetic_arm::{ARM, POSTURES, Scene, looking, scenes};
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::{Candidate, Posture, SearchView, SurfacePoint, search};
use nalgebra::{Point3, Vector3};
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

fn middle(points: &[Point3<f32>]) -> Point3<f32> {
    let sum: Vector3<f32> = points.iter().map(|point| point.coords).sum();
    Point3::from(sum / points.len().max(1) as f32)
}

fn views(scenes: &[Scene]) -> Vec<SearchView<'_>> {
    let view = |scene| {
        let scene: &Scene = scene;
        let arm_points = scene.points(2, 2);
        SearchView {
            view: scene.view(),
            middles: vec![middle(&arm_points)],
            arm_points,
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

/// What was taken for the arm in one view is something else, far away from it: were the translation the
/// mean over all views, the arm would be laid a quarter of that beside its place.
#[test]
fn a_view_whose_points_are_all_foreign_does_not_lead_the_others_astray() {
    let truth = looking(Vector3::new(0.9, -0.8, 0.9), Vector3::new(0.0, 0.0, 0.4), 2.0);
    let scenes = scenes(&truth, None);
    for foreign in 0..scenes.len() {
        for away in [Vector3::new(0.0, 0.0, 12.0), Vector3::new(-9.0, 3.0, 8.0)] {
            let mut views = views(&scenes);
            // No mask says that those points are none of the arm's.
            for view in &mut views {
                view.view.mask = None;
            }
            let of_foreign = &mut views[foreign];
            of_foreign.arm_points.iter_mut().for_each(|point| *point += away);
            of_foreign.middles = vec![middle(&of_foreign.arm_points)];
            let found = search(&ARM, &views, 1, 3);
            let (metres, degrees) = error(&truth, &found[0]);
            assert!(metres < 0.05 && degrees < 10.0, "view {foreign}: {metres} m, {degrees} deg");
        }
    }
}

/// Something beside the arm moved too, and one of the patches is the arm: the middle of all points is
/// neither's, and each of them alone would be trusted as much.
#[test]
fn of_several_patches_the_one_that_fits_in_all_views_is_taken() {
    let truth = looking(Vector3::new(0.9, -0.8, 0.9), Vector3::new(0.0, 0.0, 0.4), 2.0);
    let scenes = scenes(&truth, None);
    let mut views = views(&scenes);
    let beside = [[1.5, 0.0, 0.6], [-1.4, 0.3, 1.0], [0.2, 1.6, 0.4], [0.9, -1.2, 1.2]];
    for (view, beside) in views.iter_mut().zip(beside) {
        view.view.mask = None;
        let patch: Vec<Point3<f32>> =
            view.arm_points.iter().map(|point| point + Vector3::from(beside)).collect();
        let arm = view.middles[0];
        view.arm_points.extend(&patch);
        view.middles = vec![middle(&view.arm_points), middle(&patch), arm];
    }
    let found = search(&ARM, &views, 1, 3);
    let (metres, degrees) = error(&truth, &found[0]);
    assert!(metres < 0.05 && degrees < 10.0, "{metres} m, {degrees} deg");
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
    let mut without_middles = views(&scenes);
    without_middles[1].middles.clear();
    assert!(search(&ARM, &without_middles, 1, 3).is_empty());
    let mut without_surface = views(&scenes);
    without_surface[0].surface.clear();
    assert!(search(&ARM, &without_surface, 1, 3).is_empty());
    assert!(search(&ARM, &views(&scenes)[..1], 1, 0).is_empty());
    assert_eq!(POSTURES.len(), scenes.len());
}
