use crate::shapes::cuboid;
use crate::strategies::on_threads;
use crate::synthetic_arm::{ARM, CAMERA, Scene, looking, scenes};
use eyebolt_geometry::{Base, Camera, Tangent, Transform};
use eyebolt_registration::{
    Label, Labels, OUTLINES, OffsetPrior, Reach, RefineOptions, RefineView, Refinement, SURFACES,
    Silhouette, StopReason, Trust, refine,
};
use eyebolt_render::Raster;
use nalgebra::{Matrix6, Vector3, Vector6};

pub fn truth() -> Transform<Camera, Base> {
    looking(Vector3::new(1.1, 0.5, 0.8), Vector3::new(0.0, 0.05, 0.35), 0.1)
}

/// 3 cm and 3 degrees off, in various directions.
pub fn starts() -> Vec<Transform<Camera, Base>> {
    let directions = [[1.0, 1.0, 1.0], [-1.0, 2.0, 0.5], [0.3, -1.0, -2.0], [0.0, 0.0, 1.0]];
    let starts = directions.iter().zip(directions.iter().rev()).map(|(metres, radians)| {
        let translation = Vector3::from(*metres).normalize() * 0.03;
        let rotation = Vector3::from(*radians).normalize() * 3f64.to_radians();
        let delta: Vec<f64> = translation.iter().chain(rotation.iter()).copied().collect();
        truth().retract(&Tangent::from_column_slice(&delta))
    });
    starts.collect()
}

pub fn observed(scenes: &[Scene]) -> Vec<RefineView<'_>> {
    let one = |scene| {
        let scene: &Scene = scene;
        let labels = Labels::from_fn(0..320, 0..240, |u, v| {
            if scene.mask.at(u as u32, v as u32) { Label::Arm } else { Label::Background }
        });
        RefineView {
            view: scene.view(),
            arm_points: scene.points(3, 2),
            pixels_per_point: 4.0,
            silhouette: Silhouette::new(&labels),
        }
    };
    scenes.iter().map(one).collect()
}

pub fn refined(
    views: &[RefineView<'_>],
    start: &Transform<Camera, Base>,
    trust: Trust,
) -> Refinement {
    let mut rasters: Vec<Raster> = views.iter().map(|_| Raster::new(&CAMERA)).collect();
    let offset_prior = OffsetPrior::Estimated;
    let (iterations, reach) = (40, Reach::Far);
    let options = RefineOptions { iterations, reach, trust, offset_prior, in_full: true };
    refine(&ARM, views, &mut rasters, &(*start).into(), &options)
}

/// Millimetres of the camera in the base frame, and degrees.
fn error(pose: &Transform<Camera, Base>) -> (f64, f64) {
    let (metres, _) = truth().inverse().distance_to(&pose.inverse());
    let (_, radians) = truth().distance_to(pose);
    (metres * 1e3, radians.to_degrees())
}

fn is_a_covariance(matrix: &Matrix6<f64>) -> bool {
    let symmetric = (matrix - matrix.transpose()).amax() <= 1e-12 * matrix.amax();
    matrix.iter().all(|v| v.is_finite())
        && symmetric
        && matrix.symmetric_eigenvalues().iter().all(|v| *v > 0.0)
}

#[test]
fn from_centimetres_away_the_pose_is_found_to_less_than_half_a_millimetre() {
    let scenes = scenes(&truth(), None);
    let views = observed(&scenes);
    for start in starts() {
        let outcome = refined(&views, &start, Trust::All);
        let (mm, degrees) = error(&outcome.camera_from_base);
        assert!(mm < 0.5 && degrees < 0.05, "{mm} mm, {degrees} degrees");
        assert_eq!(outcome.stop, StopReason::Converged);
        assert!(is_a_covariance(&outcome.covariance), "{}", outcome.covariance);
        assert!(is_a_covariance(&outcome.information), "{}", outcome.information);
        assert!(outcome.depth_scale().abs() < 1e-3, "{}", outcome.depth_scale());
        assert!(outcome.deviations[SURFACES] < 2e-3, "{}", outcome.deviations[SURFACES]);
        for (fit, view) in outcome.views.iter().zip(&views) {
            assert_eq!(fit.points, view.arm_points.len());
            assert!(fit.surface_m().unwrap() < 1e-3 && fit.outline_px().unwrap() < 1.0, "{fit:?}");
            assert!(fit.fits[SURFACES].inliers * 10 > fit.points * 9, "{fit:?}");
        }
    }
}

#[test]
fn surfaces_and_outlines_agree_where_there_is_no_noise() {
    let scenes = scenes(&truth(), None);
    let views = observed(&scenes);
    for trust in [SURFACES, OUTLINES].map(Trust::Only) {
        let outcome = refined(&views, &starts()[0], trust);
        let (mm, degrees) = error(&outcome.camera_from_base);
        assert!(mm < 1.2 && degrees < 0.05, "{trust:?}: {mm} mm, {degrees} degrees");
    }
}

#[test]
fn a_plate_beside_the_arm_that_is_marked_as_arm_does_little_harm() {
    let plate = cuboid([0.005, 0.12, 0.14], [0.06, -0.15, 0.45]);
    let scenes = scenes(&truth(), Some(&plate));
    let views = observed(&scenes);
    let clean = crate::synthetic_arm::scenes(&truth(), None);
    let marked = |scenes: &[Scene]| scenes.iter().map(|s| s.mask.count()).sum::<usize>();
    let share = marked(&scenes) as f64 / marked(&clean) as f64;
    assert!(share > 1.03, "the plate shows: {share}");
    for start in starts() {
        let outcome = refined(&views, &start, Trust::All);
        let (mm, degrees) = error(&outcome.camera_from_base);
        assert!(mm < 2.0 && degrees < 0.2, "{mm} mm, {degrees} degrees");
        assert!(is_a_covariance(&outcome.covariance), "{}", outcome.covariance);
    }
}

#[test]
fn a_depth_that_is_too_short_shows_in_its_scale() {
    let mut scenes = scenes(&truth(), None);
    for scene in &mut scenes {
        let shorter = scene.depth.depth_m().iter().map(|z| z / 1.01).collect();
        scene.depth = eyebolt_geometry::DepthImage::new(320, 240, shorter).unwrap();
    }
    let outcome = refined(&observed(&scenes), &truth(), Trust::All);
    let (mm, degrees) = error(&outcome.camera_from_base);
    assert!((outcome.depth_scale() - 0.01).abs() < 0.002, "{}", outcome.depth_scale());
    assert!(mm < 3.0 && degrees < 0.1, "{mm} mm, {degrees} degrees");
}

#[test]
fn an_outline_seen_too_wide_shows_as_excess() {
    let scenes = scenes(&truth(), None);
    for (grow, excess_px) in [(false, 0.0), (true, 1.0)] {
        let mut views = observed(&scenes);
        for (view, scene) in views.iter_mut().zip(&scenes) {
            let mask = if grow { scene.mask.dilated(1) } else { scene.mask.clone() };
            let labels = Labels::from_fn(0..320, 0..240, |u, v| {
                if mask.at(u as u32, v as u32) { Label::Arm } else { Label::Background }
            });
            view.silhouette = Silhouette::new(&labels);
        }
        let found_px = refined(&views, &truth(), Trust::All).outline_px();
        assert!((found_px - excess_px).abs() < 0.3, "{found_px} instead of {excess_px} pixels");
    }
}

#[test]
fn one_thread_or_two_give_the_same_bytes() {
    let scenes = scenes(&truth(), None);
    let views = observed(&scenes);
    let start = starts()[1];
    let outcomes = [1, 2].map(|threads| {
        let outcome = on_threads(threads, || refined(&views, &start, Trust::All));
        let pose = outcome.camera_from_base.matrix();
        let numbers =
            pose.iter().chain(outcome.covariance.iter()).chain(outcome.information.iter());
        let bits: Vec<u64> = numbers.map(|number| number.to_bits()).collect();
        (bits, format!("{outcome:?}"))
    });
    assert_eq!(outcomes[0], outcomes[1]);
}

#[test]
fn without_evidence_the_pose_is_underdetermined_and_stays() {
    let scenes = scenes(&truth(), None);
    let nothing = Silhouette::new(&Labels::from_fn(0..320, 0..240, |_, _| Label::Ignore));
    let mut views = observed(&scenes);
    for view in &mut views {
        view.arm_points.clear();
        view.silhouette = nothing.clone();
    }
    for views in [&views[..], &[]] {
        let outcome = refined(views, &truth(), Trust::All);
        assert_eq!(outcome.stop, StopReason::Underdetermined);
        assert_eq!(outcome.camera_from_base, truth());
        assert_eq!(outcome.views.len(), views.len());
        assert!(outcome.views.iter().all(|fit| fit.points == 0 && fit.outline_px().is_none()));
        assert!(outcome.covariance.iter().all(|v| *v == f64::INFINITY));
        assert_eq!(outcome.last_step, Vector6::zeros());
    }
}

#[test]
fn a_single_point_does_not_determine_a_pose() {
    let scenes = scenes(&truth(), None);
    let mut views = observed(&scenes);
    let nothing = Silhouette::new(&Labels::from_fn(0..320, 0..240, |_, _| Label::Ignore));
    for view in &mut views {
        view.arm_points.clear();
        view.silhouette = nothing.clone();
    }
    views[0].arm_points = scenes[0].points(3, 2)[..1].to_vec();
    let outcome = refined(&views, &truth(), Trust::All);
    assert_eq!(outcome.stop, StopReason::Underdetermined);
}
