//! What is true of every plan.

use crate::stage::{ARM, PLAN, camera, request};
use eyebolt::plan::{Plan, PlanRequest, Speed, TimedPoint, assumed_cameras, plan_next};
use nalgebra::Point3;
use std::collections::BTreeSet;

fn plan(change: impl FnOnce(&mut PlanRequest<'_>)) -> Plan {
    let cameras = [camera()];
    let mut request = request(&cameras);
    change(&mut request);
    plan_next(&request)
}

/// Places of the way, so near that no part of the arm moves a centimetre from one to the next.
fn way(trajectory: &[TimedPoint]) -> Vec<Vec<f64>> {
    let pairs = trajectory.windows(2).flat_map(|pair| {
        let (from, to) = (&pair[0].positions, &pair[1].positions);
        let most = from.iter().zip(to).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let parts = (most / 0.01).ceil().max(1.0) as usize;
        (0..parts).map(move |part| {
            let along = part as f64 / parts as f64;
            from.iter().zip(to).map(|(a, b)| a + along * (b - a)).collect::<Vec<f64>>()
        })
    });
    pairs.collect()
}

#[test]
fn all_are_within_limits_and_free_and_so_is_the_way() {
    assert_eq!(PLAN.configurations.len(), 6);
    let configurations = PLAN.configurations.iter().map(|one| one.positions.clone());
    let places: Vec<Vec<f64>> = configurations.chain(way(&PLAN.trajectory)).collect();
    assert!(places.len() > 500);
    let robot = ARM.arm().robot();
    for positions in places {
        for (joint, at) in ARM.joints().iter().zip(&positions) {
            let limits = robot.joints[robot.joint_index(&joint.name).unwrap()].limits.unwrap();
            assert!((limits.lower..=limits.upper).contains(at), "{}: {at}", joint.name);
        }
        assert_eq!(ARM.blocked(&positions, true), None, "{positions:?}");
    }
}

#[test]
fn the_end_effector_is_in_the_image() {
    let camera = camera();
    for planned in &PLAN.configurations {
        let joints = ARM.all_joints(&planned.positions);
        let hand = ARM.arm().base_from_end_effector(&joints).unwrap();
        let hand = camera.camera_from_base.point(&Point3::from(hand.translation_m()));
        let pixel = camera.camera.project(&hand).unwrap();
        assert!(camera.camera.contains(&pixel), "{pixel}");
        assert!((0.5..=1.0).contains(&planned.in_view_share));
    }
}

#[test]
fn each_configuration_makes_the_error_smaller() {
    let errors: Vec<_> = PLAN.configurations.iter().map(|one| one.expected).collect();
    for pair in errors.windows(2) {
        assert!(pair[1].translation_m < pair[0].translation_m, "{pair:?}");
        assert!(pair[1].rotation_rad < pair[0].rotation_rad, "{pair:?}");
    }
    let more = plan(|request| request.count = 9);
    let last = |plan: &Plan| plan.configurations.last().unwrap().expected.translation_m;
    assert!(last(&more) < last(&PLAN));
}

/// No six of the configurations that there are to choose from by chance are expected to be as good.
#[test]
fn planned_ones_are_better_than_random_ones() {
    let cameras = [camera()];
    let random = eyebolt::plan::free_and_in_view(&request(&cameras), 60);
    let expected = eyebolt::plan::expected_with(&request(&cameras), &random[..6]);
    let planned = PLAN.configurations.last().unwrap().expected;
    for six in random.chunks(6) {
        let other = eyebolt::plan::expected_with(&request(&cameras), six);
        assert!(planned.translation_m < other.translation_m, "{other:?}");
    }
    assert!(planned.translation_m < 0.8 * expected.translation_m);
}

#[test]
fn the_seed_decides_and_threads_do_not() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| plan(|request| request.seed = 5))
    };
    let (one, several) = (on(1), on(3));
    assert_eq!(one, several);
    assert_ne!(one.configurations, PLAN.configurations);
}

#[test]
fn the_way_begins_where_the_arm_is_and_rests_in_each() {
    let start = vec![0.0, -0.4, 0.0, -2.0, 0.0, 1.8, 0.8];
    let planned = plan(|request| request.start = Some(start.clone()));
    assert!(planned.from_start);
    assert_eq!(planned.trajectory[0].positions, start);
    let rests: BTreeSet<usize> = planned
        .configurations
        .iter()
        .map(|one| {
            let is_rest = |pair: &[TimedPoint]| {
                pair.iter().all(|point| point.positions == one.positions)
                    && (pair[1].at_s - pair[0].at_s - 3.0).abs() < 1e-9
            };
            planned.trajectory.windows(2).position(is_rest).expect("a rest in each")
        })
        .collect();
    assert_eq!(rests.len(), 6);
    assert!(planned.configurations.iter().all(|one| one.via.is_some()));
    assert_eq!(PLAN.configurations[0].via, None);
}

#[test]
fn no_joint_is_faster_than_said() {
    let speed = Speed::new(ARM.joints(), 0.1, 0.05);
    let slow = plan(|request| request.speed = speed);
    let mut fastest: f64 = 0.0;
    for pair in slow.trajectory.windows(2) {
        let seconds = pair[1].at_s - pair[0].at_s;
        assert!(seconds > 0.0);
        for (from, to) in pair[0].positions.iter().zip(&pair[1].positions) {
            fastest = fastest.max((to - from).abs() / seconds);
        }
        for velocity in &pair[1].velocities {
            fastest = fastest.max(velocity.abs());
        }
    }
    assert!(fastest <= 0.1 + 1e-9 && fastest > 0.08, "{fastest}");
    let hurried = plan(|request| request.speed = Speed::new(ARM.joints(), 99.0, 9.0));
    for pair in hurried.trajectory.windows(2) {
        for ((joint, from), to) in
            ARM.joints().iter().zip(&pair[0].positions).zip(&pair[1].positions)
        {
            let speed = (to - from).abs() / (pair[1].at_s - pair[0].at_s);
            assert!(speed <= 0.25 * joint.most_per_s.unwrap() + 1e-9, "{speed}");
        }
    }
}

#[test]
fn a_camera_that_nobody_knows_is_one_of_several() {
    let cameras = assumed_cameras(0.85, 1);
    let planned = plan_next(&request(&cameras));
    assert_eq!(planned.configurations.len(), 6);
    assert!(planned.configurations.iter().all(|one| one.seen_by >= 0.5));
    assert_eq!(planned.before, None);
}

#[test]
fn a_camera_that_looks_away_gets_reasons() {
    let mut away = camera();
    let turn = nalgebra::UnitQuaternion::from_euler_angles(0.0, std::f64::consts::PI, 0.0);
    let turned = eyebolt_geometry::Transform::from_parts(nalgebra::Vector3::zeros(), turn);
    away.camera_from_base = turned * away.camera_from_base;
    let cameras = [away];
    let request = request(&cameras);
    let planned = plan_next(&request);
    assert!(planned.configurations.is_empty() && planned.trajectory.is_empty());
    assert!(planned.drawn.out_of_view > 9 * planned.drawn.drawn / 10);
    let document = eyebolt::plan::PlanDocument::new(&request, &planned);
    assert!(document.why_fewer.unwrap().starts_with("0 of 6: only 0 configurations"));
}
