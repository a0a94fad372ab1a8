//! Poses of flat markers from exact points.

use crate::noise::normal;
use crate::strategies::{config, vector};
use eyebolt_geometry::{Camera, Distortion, PinholeCamera, Transform, rotation_exp};
use eyebolt_markers::{Correspondence, Marker, planar_poses};
use nalgebra::{Point2, Point3, Vector3};
use proptest::prelude::*;

pub fn camera() -> PinholeCamera {
    let lens = Distortion::plumb_bob([0.1, -0.2, 0.002, -0.001, 0.05]);
    PinholeCamera::new(640, 480, 610.0, 612.0, 322.0, 241.0, lens).unwrap()
}

pub fn square(side_m: f64) -> Vec<Point3<f64>> {
    let half = 0.5 * side_m;
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .map(|(x, y)| Point3::new(x * half, y * half, 0.0))
        .to_vec()
}

pub fn seen(
    pose: &Transform<Camera, Marker>,
    points: &[Point3<f64>],
    camera: &PinholeCamera,
) -> Option<Vec<Correspondence>> {
    let each = points.iter().map(|point| {
        let pixel = camera.project(&pose.point(point))?;
        Some(Correspondence { point_in_marker: *point, pixel })
    });
    each.collect()
}

proptest! {
    #![proptest_config(config(256))]

    #[test]
    fn exact_corners_give_the_pose_back(
        tilt in vector(1.2), turn in -3.1..3.1, x in -0.3..0.3, y in -0.2..0.2, z in 0.3..2.0,
    ) {
        let rotation = rotation_exp(&Vector3::new(tilt.x, tilt.y, 0.0))
            * rotation_exp(&(Vector3::z() * turn));
        let pose = Transform::from_parts(Vector3::new(x * z, y * z, z), rotation);
        let camera = camera();
        let points = seen(&pose, &square(0.1), &camera).unwrap();
        let poses = planar_poses(&points, &camera);
        prop_assert!(!poses.is_empty());
        let (metres, radians) = poses[0].camera_from_marker.distance_to(&pose);
        prop_assert!(metres < 1e-6 && radians < 1e-5, "{metres} m, {radians} rad of {poses:?}");
        prop_assert!(poses[0].rms_px < 1e-6);
    }

    /// From afar both ways of turning look alike; one of the two has to be the right one.
    #[test]
    fn one_of_the_poses_is_right_where_two_look_alike(
        tilt in vector(0.9), turn in -3.1..3.1, seed in 0_u64..1_000_000,
    ) {
        let rotation = rotation_exp(&Vector3::new(tilt.x, tilt.y, 0.0))
            * rotation_exp(&(Vector3::z() * turn));
        let pose = Transform::from_parts(Vector3::new(0.1, 0.05, 1.5), rotation);
        let camera = camera();
        let mut points = seen(&pose, &square(0.1), &camera).unwrap();
        for (i, point) in points.iter_mut().enumerate() {
            let place = 2 * i as u64;
            point.pixel += nalgebra::Vector2::new(normal(seed, place), normal(seed, place + 1)) * 0.05;
        }
        let poses = planar_poses(&points, &camera);
        let right = poses.iter().any(|p| p.camera_from_marker.distance_to(&pose).1 < 0.15);
        prop_assert!(right, "{pose:?} {poses:?}");
    }
}

#[test]
fn points_that_determine_no_pose_give_none() {
    let camera = camera();
    let pose: Transform<Camera, Marker> =
        Transform::from_parts(Vector3::new(0.0, 0.0, 1.0), nalgebra::UnitQuaternion::identity());
    let line: Vec<_> = (0..5).map(|i| Point3::new(0.02 * f64::from(i), 0.0, 0.0)).collect();
    for points in [&square(0.1)[..3], &line, &[]] {
        assert_eq!(planar_poses(&seen(&pose, points, &camera).unwrap(), &camera), []);
    }
    let solid = [Point3::new(0.0, 0.0, 0.05), Point3::new(0.1, 0.0, 0.0)];
    let both = [square(0.1), solid.to_vec()].concat();
    assert_eq!(planar_poses(&seen(&pose, &both, &camera).unwrap(), &camera), []);
    let nowhere =
        Correspondence { point_in_marker: Point3::origin(), pixel: Point2::new(f64::NAN, 0.0) };
    assert_eq!(planar_poses(&[nowhere; 5], &camera), []);
}

proptest! {
    #![proptest_config(config(64))]

    /// Whatever is given, poses are finite and in front of the camera.
    #[test]
    fn wild_points_make_no_wild_poses(
        at in prop::collection::vec((-1e3..1e3, -1e3..1e3), 4..8),
    ) {
        let camera = camera();
        let points: Vec<_> = at.iter().enumerate().map(|(i, (u, v))| Correspondence {
            point_in_marker: Point3::new(f64::from(i as u32 % 3), f64::from(i as u32 / 3), 0.0),
            pixel: Point2::new(*u, *v),
        }).collect();
        for found in planar_poses(&points, &camera) {
            prop_assert!(found.rms_px.is_finite());
            prop_assert!(found.camera_from_marker.matrix().iter().all(|v| v.is_finite()));
        }
    }
}
