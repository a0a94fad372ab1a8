//! One rigid shape, from starts that are off, by points that are noisy and partly wrong.

use crate::shapes::{cuboid, joined};
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::{
    ArmLink, ArmModel, Errors, IcpOptions, LinkModel, Posture, StopReason, clustered_covariance,
    icp,
};
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

/// Errors that patches of 2 cm share, by chance: what both covariances say of a pose is what many fits scatter by.
#[test]
fn patches_that_err_together_are_in_the_covariance() {
    const PATCH_M: f64 = 0.02;
    const DEVIATION_M: f64 = 0.001;
    let (arm, posture) = shape();
    let options = IcpOptions::default();
    // A corner is seen, so that nothing slides.
    let rotation = UnitQuaternion::from_euler_angles(0.6, 0.7, 0.3);
    let truth = Transform::from_parts(Vector3::new(0.1, -0.05, 0.9), rotation);
    let seen: Vec<Point3<f64>> = arm.links()[0]
        .model
        .surface
        .iter()
        .filter_map(|of| {
            let point = truth.point(&of.point.cast());
            (truth.direction(&of.normal.cast()).dot(&point.coords) < -0.2).then_some(point)
        })
        .collect();
    let cell = |value: f64| (value / PATCH_M).floor() as i64;
    let cluster: Vec<u32> =
        seen.iter().map(|point| (100 * (cell(point.x) + 50) + cell(point.y) + 50) as u32).collect();
    let (mut errors, mut as_seen, mut alike) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    let cases = 150;
    for case in 0..cases {
        let random = Random::new(23).at(case);
        let points: Vec<Point3<f32>> = seen
            .iter()
            .zip(&cluster)
            .map(|(point, cluster)| {
                let size = DEVIATION_M * random.at(u64::from(*cluster)).normal();
                (point + size * point.coords.normalize()).cast()
            })
            .collect();
        let fit = icp(&arm, &posture, &points, &truth, &options);
        let off = fit.camera_from_base.distance_to(&truth);
        let said = |errors| {
            let covariance =
                clustered_covariance((&arm, &posture), &points, errors, &fit, &options).unwrap();
            [0, 3].map(|first| (first..first + 3).map(|at| covariance[(at, at)]).sum::<f64>())
        };
        let seen = said(Errors::AsSeen(&cluster));
        // Along the ray; the normal is turned from it by half a right angle or so.
        let known = said(Errors::Alike(&cluster, DEVIATION_M / 3f64.sqrt()));
        for (part, off) in [off.0, off.1].into_iter().enumerate() {
            errors[part] += off * off;
            as_seen[part] += seen[part];
            alike[part] += known[part];
        }
    }
    for part in 0..2 {
        let ratios = [as_seen, alike].map(|said| (said[part] / errors[part]).sqrt());
        assert!(ratios.iter().all(|ratio| (0.7..1.4).contains(ratio)), "{part}: {ratios:?}");
    }
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
