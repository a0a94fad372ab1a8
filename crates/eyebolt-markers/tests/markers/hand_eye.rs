//! Hand-eye calibration on exact and on noisy data.

use crate::noise::normal;
use crate::single::{camera, seen, square};
use crate::strategies::{config, poses, transform};
use eyebolt_geometry::{
    Base, Camera, CoordinateFrame, EndEffector, Tangent, Transform, rotation_exp,
};
use eyebolt_markers::hand_eye::{
    HandEye, HandEyeError, PosePair, Solver, View, refine, refine_poses, solve, starts,
};
use eyebolt_markers::{Marker, planar_poses};
use nalgebra::{Point3, UnitQuaternion, Vector2, Vector3};
use proptest::prelude::*;
use std::f64::consts::PI;

fn pairs<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    truth: &HandEye<Root, Carrier>,
    robot: &[Transform<Root, Carrier>],
) -> Vec<PosePair<Root, Carrier>> {
    let pair = |pose: &Transform<Root, Carrier>| PosePair {
        root_from_carrier: *pose,
        camera_from_marker: truth.camera_from_marker(pose),
    };
    robot.iter().map(pair).collect()
}

/// Whether the answer is `truth`, within metres and radians.
fn near<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    found: &HandEye<Root, Carrier>,
    truth: &HandEye<Root, Carrier>,
    limit: f64,
) -> bool {
    let camera = found.camera_from_root.distance_to(&truth.camera_from_root);
    let marker = found.carrier_from_marker.distance_to(&truth.carrier_from_marker);
    [camera.0, camera.1, marker.0, marker.1].iter().all(|off| *off < limit)
}

proptest! {
    #![proptest_config(config(128))]

    /// Eye-to-hand: a marker on the hand, a camera that stands still, anywhere and turned in any way.
    #[test]
    fn exact_poses_give_the_camera_back_eye_to_hand(
        camera_from_root in transform::<Camera, Base>(2.0, 0.0..PI),
        carrier_from_marker in transform::<EndEffector, Marker>(0.2, 0.0..PI),
        robot in poses(),
    ) {
        let truth = HandEye { camera_from_root, carrier_from_marker };
        for solver in Solver::ALL {
            let found = solve(solver, &pairs(&truth, &robot)).unwrap();
            prop_assert!(near(&found, &truth, 1e-6), "{solver:?}: {found:?} {truth:?}");
        }
        let off = Tangent::new(0.02, -0.01, 0.03, 0.1, -0.05, 0.08);
        let start = HandEye { camera_from_root: truth.camera_from_root.retract(&off), ..truth };
        let found = refine_poses(&pairs(&truth, &robot), &start, 0.05).unwrap();
        prop_assert!(near(&found, &truth, 1e-6), "refined: {found:?} {truth:?}");
    }

    /// Eye-in-hand: the same with the robot's poses the other way round.
    #[test]
    fn exact_poses_give_the_camera_back_eye_in_hand(
        camera_from_root in transform::<Camera, EndEffector>(0.2, 0.0..PI),
        carrier_from_marker in transform::<Base, Marker>(2.0, 0.0..PI),
        robot in poses(),
    ) {
        let truth = HandEye { camera_from_root, carrier_from_marker };
        let robot: Vec<_> = robot.iter().map(Transform::inverse).collect();
        for solver in Solver::ALL {
            let found = solve(solver, &pairs(&truth, &robot)).unwrap();
            prop_assert!(near(&found, &truth, 1e-6), "{solver:?}: {found:?} {truth:?}");
        }
    }

    /// Turning the base's axes turns the answer along.
    #[test]
    fn answers_follow_the_frames(
        camera_from_root in transform::<Camera, Base>(2.0, 0.0..PI),
        carrier_from_marker in transform::<EndEffector, Marker>(0.2, 0.0..PI),
        moved in transform::<Base, Base>(1.0, 0.0..PI),
        robot in poses(), seed in 0_u64..1_000_000,
    ) {
        let truth = HandEye { camera_from_root, carrier_from_marker };
        let moved = Transform::from_parts(Vector3::zeros(), moved.rotation());
        let mut noisy = pairs(&truth, &robot);
        for (i, pair) in noisy.iter_mut().enumerate() {
            let n = |k: u64| 1e-3 * normal(seed, 6 * i as u64 + k);
            let off = Tangent::new(n(0), n(1), n(2), n(3), n(4), n(5));
            pair.camera_from_marker = pair.camera_from_marker.retract(&off);
        }
        let turned: Vec<_> = noisy.iter().map(|pair| PosePair {
            root_from_carrier: moved * pair.root_from_carrier, ..*pair
        }).collect();
        // The others' equations are of single axes.
        for solver in [Solver::ParkMartin, Solver::HoraudDornaika] {
            let (a, b) = (solve(solver, &noisy).unwrap(), solve(solver, &turned).unwrap());
            let (metres, radians) = (b.camera_from_root * moved).distance_to(&a.camera_from_root);
            prop_assert!(metres < 1e-6 && radians < 1e-6, "{solver:?}: {metres} m, {radians} rad");
        }
    }
}

/// A camera across the table and a marker on the hand, as in a laboratory.
fn laboratory(seed: u64) -> (HandEye<Base, EndEffector>, Vec<Transform<Base, EndEffector>>) {
    let look =
        rotation_exp(&Vector3::new(0.0, 2.2, 0.0)) * rotation_exp(&Vector3::new(0.0, 0.0, 1.3));
    let camera_from_root = Transform::from_parts(Vector3::new(0.1, 0.2, 1.1), look);
    let truth = HandEye {
        camera_from_root,
        carrier_from_marker: Transform::from_parts(
            Vector3::new(0.01, -0.02, 0.06),
            UnitQuaternion::identity(),
        ),
    };
    // The marker towards the camera, give or take half a radian.
    let towards = camera_from_root.inverse().rotation();
    let robot = (0..12_u64).map(|i| {
        let n = |k: u64| normal(seed, 10 * i + k);
        let tilt = rotation_exp(&(Vector3::new(n(0), n(1), 2.0 * n(2)) * 0.35));
        let in_camera = Point3::new(0.12 * n(3), 0.08 * n(4), 1.0 + 0.12 * n(5));
        let at = camera_from_root.inverse().point(&in_camera);
        Transform::from_parts(at.coords, towards * tilt)
    });
    (truth, robot.collect())
}

fn views(
    truth: &HandEye<Base, EndEffector>,
    robot: &[Transform<Base, EndEffector>],
    side_m: f64,
    sigma_px: f64,
    seed: u64,
) -> Vec<View<Base, EndEffector>> {
    let camera = camera();
    let each = robot.iter().enumerate().map(|(i, pose)| {
        let mut points = seen(&truth.camera_from_marker(pose), &square(side_m), &camera).unwrap();
        for (k, point) in points.iter_mut().enumerate() {
            let place = (1000 * i + 2 * k) as u64;
            point.pixel += Vector2::new(normal(seed, place), normal(seed, place + 1)) * sigma_px;
        }
        let poses = planar_poses(&points, &camera);
        View { root_from_carrier: *pose, points, poses }
    });
    each.collect()
}

#[test]
fn refinement_finds_exact_data_exactly_from_every_start() {
    let (truth, robot) = laboratory(3);
    let views = views(&truth, &robot, 0.1, 0.0, 0);
    for start in starts(&views) {
        let refined = refine(&views, &camera(), &start.answer.unwrap()).unwrap();
        assert!(near(&refined.hand_eye, &truth, 1e-7), "{:?}: {refined:?}", start.solver);
        assert!(refined.size_error.abs() < 1e-7 && refined.last_step < 1e-6);
    }
}

#[test]
fn refinement_survives_a_wrong_view_and_a_wrong_size() {
    let (truth, robot) = laboratory(4);
    // The sheet was printed one percent too large: what is seen is of 0.101 m.
    let mut views = views(&truth, &robot, 0.101, 0.2, 5);
    for point in views.iter_mut().flat_map(|view| &mut view.points) {
        point.point_in_marker = Point3::from(point.point_in_marker.coords / 1.01);
    }
    for view in &mut views {
        view.poses = planar_poses(&view.points, &camera());
    }
    // The robot was elsewhere when the fifth picture was taken.
    let away = Tangent::new(0.1, -0.05, 0.08, 0.3, 0.2, -0.4);
    views[4].root_from_carrier = views[4].root_from_carrier.retract(&away);
    let best = starts(&views)
        .into_iter()
        .filter_map(|start| refine(&views, &camera(), &start.answer.ok()?))
        .min_by(|a, b| a.cost.total_cmp(&b.cost))
        .unwrap();
    assert!(near(&best.hand_eye, &truth, 0.006), "{best:?} {truth:?}");
    assert!((best.size_error - 0.01).abs() < 0.005, "{}", best.size_error);
    assert!(best.views[4].weight < 0.1 && best.views[3].weight > 0.7, "{:?}", best.views);
}

/// Beside this, `examples/noise_study.py` compares with OpenCV.
#[test]
fn covariance_is_about_as_large_as_errors_are_and_refinement_is_best() {
    let (mut squared, mut left_out) = (Vec::new(), Vec::new());
    let (mut fine, mut coarse) = (Vec::new(), [const { Vec::new() }; 4]);
    for seed in 0..60 {
        let (truth, robot) = laboratory(seed);
        let views = views(&truth, &robot, 0.1, 0.3, seed);
        let starts = starts(&views);
        let wrong = |answer: &HandEye<Base, EndEffector>| {
            answer.camera_from_root.distance_to(&truth.camera_from_root).0
        };
        for (start, errors) in starts.iter().zip(&mut coarse) {
            errors.push(wrong(&start.answer.unwrap()));
        }
        let refined = refine(&views, &camera(), &starts[1].answer.unwrap()).unwrap();
        fine.push(wrong(&refined.hand_eye));
        let off = refined.hand_eye.camera_from_root.local(&truth.camera_from_root);
        squared.push(off.dot(&(refined.covariance.try_inverse().unwrap() * off)) / 6.0);
        // Twelve views tell the size of an error, not its shape in all directions.
        let expected = refined.left_out.unwrap().covariance.fixed_view::<3, 3>(0, 0).trace();
        left_out.push(off.fixed_rows::<3>(0).norm_squared() / expected);
    }
    let middle = |mut all: Vec<f64>| {
        all.sort_by(f64::total_cmp);
        all[all.len() / 2]
    };
    for all in [squared, left_out].map(middle) {
        // The median of chi-square over its degrees of freedom is 0.8 to 0.9.
        assert!((0.3..2.0).contains(&all), "{all}");
    }
    let (fine, coarse) = (middle(fine), coarse.map(middle));
    assert!(coarse.iter().all(|coarse| fine < 0.5 * coarse), "{fine} of {coarse:?}");
}

#[test]
fn what_leaves_the_camera_open_is_refused() {
    let (truth, robot) = laboratory(1);
    let all = pairs(&truth, &robot);
    let first = all[0].root_from_carrier;
    let about = |axes: [f64; 3], i: usize| {
        let turn = rotation_exp(&(Vector3::from(axes) * (0.2 * i as f64)));
        first
            * Transform::<EndEffector, EndEffector>::from_parts(
                Vector3::x() * (0.03 * i as f64),
                turn,
            )
    };
    let still = |i: usize| about([0.0; 3], i);
    let one_axis = |i: usize| about([0.3, 0.9, 0.0], i);
    for solver in Solver::ALL {
        let few = solve(solver, &all[..2]).unwrap_err();
        assert_eq!(few, HandEyeError::FewPoses { poses: 2 });
        for robot in [(0..6).map(still).collect::<Vec<_>>(), (0..6).map(one_axis).collect()] {
            let error = solve(solver, &pairs(&truth, &robot)).unwrap_err();
            assert!(matches!(error, HandEyeError::ParallelAxes { .. }), "{solver:?}: {error:?}");
        }
    }
    assert!(starts::<Base, EndEffector>(&[]).iter().all(|start| start.answer.is_err()));
}
