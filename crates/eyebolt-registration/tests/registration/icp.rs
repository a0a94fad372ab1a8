//! One rigid shape, from starts that are off, by points that are noisy and partly wrong.

use crate::shapes::{cuboid, joined};
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::{ArmLink, ArmModel, IcpOptions, LinkModel, Posture, StopReason, icp};
use eyebolt_render::Random;
use nalgebra::{Point3, UnitQuaternion, Vector3};
use std::sync::Arc;

/// A body with a lug on one side: no turn of it looks the same.
fn shape() -> (ArmModel, Posture) {
    let mesh = joined(&[
        cuboid([0.06, 0.18, 0.08], [0.0, 0.0, 0.04]),
        cuboid([0.03, 0.04, 0.06], [0.045, 0.05, 0.03]),
        cuboid([0.02, 0.02, 0.06], [0.0, -0.06, 0.11]),
    ]);
    let link = ArmLink { name: "hand".into(), model: Arc::new(LinkModel::build(&mesh)) };
    let arm = ArmModel::new(vec![link]);
    let posture = Posture::new(&arm, vec![Transform::identity()]);
    (arm, posture)
}

/// Points of the sides that a camera sees, with noise of 1 mm; one in ten is a few centimetres off.
fn seen(arm: &ArmModel, pose: &Transform<Camera, Base>, random: Random) -> Vec<Point3<f32>> {
    let surface = &arm.links()[0].model.surface;
    let seen = surface.iter().filter_map(|of| {
        let point = pose.point(&of.point.cast());
        (pose.direction(&of.normal.cast()).dot(&point.coords) < 0.0).then_some(point)
    });
    let noisy = seen.zip(0..).map(|(point, index)| {
        let mut random = random.at(index);
        let size = if random.uniform() < 0.1 { 0.03 } else { 0.001 };
        (point + size * Vector3::from_fn(|_, _| random.normal())).cast()
    });
    noisy.collect()
}

/// A rotation about any axis.
fn turn(random: &mut Random, angle: f64) -> UnitQuaternion<f64> {
    let axis = Vector3::from_fn(|_, _| random.normal()).normalize();
    UnitQuaternion::from_scaled_axis(angle * axis)
}

#[test]
fn starts_two_centimetres_and_ten_degrees_off_come_to_the_truth() {
    let (arm, posture) = shape();
    let (mut found, mut converged) = (0, 0);
    for case in 0..100 {
        let mut random = Random::new(17).at(case);
        let rotation = turn(&mut random, 3.0);
        let truth = Transform::from_parts(Vector3::new(0.1, -0.05, 0.9), rotation);
        let points = seen(&arm, &truth, random.at(1));
        let off = Vector3::from_fn(|_, _| random.normal()).normalize() * 0.02;
        let start = Transform::from_parts(
            truth.translation_m() + off,
            turn(&mut random, 10_f64.to_radians()) * rotation,
        );
        let fit = icp(&arm, &posture, &points, &start, &IcpOptions::default());
        let (metres, radians) = fit.camera_from_base.distance_to(&truth);
        // A side seen from the front slides along itself: the fit says so.
        let covariance = fit.information.try_inverse().unwrap() * fit.deviation_m.powi(2);
        let deviation =
            |first: usize| (first..first + 3).map(|at| covariance[(at, at)]).sum::<f64>().sqrt();
        let near = metres < 4.0 * deviation(0) + 0.0005;
        if near && radians < 4.0 * deviation(3) + 0.005 {
            found += 1;
            converged += usize::from(fit.stop == StopReason::Converged);
            assert!((0.0004..0.0025).contains(&fit.deviation_m), "{}", fit.deviation_m);
            assert!(fit.inliers > 0.8, "{}", fit.inliers);
        }
    }
    assert!(found >= 97 && converged >= 75, "{found} of 100, {converged} converged");
}

#[test]
fn what_does_not_determine_a_pose_is_said() {
    let (arm, posture) = shape();
    let start = Transform::from_parts(Vector3::new(0.0, 0.0, 0.8), UnitQuaternion::identity());
    for points in [vec![], vec![Point3::new(0.0, 0.0, 0.8)], vec![Point3::new(9.0, 9.0, 9.0); 50]] {
        let fit = icp(&arm, &posture, &points, &start, &IcpOptions::default());
        assert_eq!(fit.stop, StopReason::Underdetermined);
        assert_eq!(fit.camera_from_base, start);
    }
}
