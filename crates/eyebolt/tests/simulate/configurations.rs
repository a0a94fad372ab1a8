//! The configurations that are chosen: possible ones, and such that the camera sees the hand.

use crate::shapes::{self, Placed, seen};
use crate::stage::{ARM, AS_SAID, CACHE, Recorded, SENSOR, apart, bytes, planned, preset, small};
use eyebolt::simulate::{Scenario, SimulateError, Viewpoint, plan};
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_render::Sensor;
use eyebolt_robot::{Input, JointPositions, Prefer, TriangleMesh, link_mesh};
use nalgebra::{Point2, Point3};
use std::sync::LazyLock;

/// Configurations from several places, with where the camera is.
static CHOSEN: LazyLock<Vec<(JointPositions, Transform<Base, Camera>)>> = LazyLock::new(|| {
    let views = ["paper-test-p1", "paper-train-p3"].map(preset);
    let anywhere = Viewpoint::Within(eyebolt::simulate::Ranges::default());
    let views = views.into_iter().chain([anywhere]).zip(20..);
    let chosen = views.flat_map(|(viewpoint, seed)| {
        let plan = planned(Scenario { viewpoint, seed, configurations: 6, frames: 1, ..small() });
        let base_from_camera = plan.camera_from_base().inverse();
        let joints = Recorded::of_plan(&plan).joints();
        joints.into_iter().map(move |joints| (joints, base_from_camera))
    });
    chosen.collect()
});

#[test]
fn joints_are_within_their_limits() {
    let robot = ARM.robot();
    let names = [ARM.required_joints(), ARM.other_joints()].concat();
    assert_eq!(CHOSEN.len(), 18);
    for (joints, _) in CHOSEN.iter() {
        assert!(joints.iter().map(|(name, _)| name).all(|name| names.contains(&name)));
        assert_eq!(joints.len(), 8, "seven joints and a finger: the other one follows");
        for (name, position) in joints.iter() {
            let limits = robot.joints[robot.joint_index(name).unwrap()].limits.unwrap();
            assert!((limits.lower..=limits.upper).contains(&position), "{name}: {position}");
        }
    }
}

#[test]
fn configurations_differ() {
    for configurations in CHOSEN.chunks(6) {
        for (i, (a, _)) in configurations.iter().enumerate() {
            let before = configurations[..i].iter().map(|(b, _)| apart(a, b));
            assert!(before.fold(f64::INFINITY, f64::min) > 0.2);
        }
    }
}

/// Points on a mesh no farther than about a centimetre from each other.
fn sampled(mesh: &TriangleMesh) -> Vec<Point3<f64>> {
    let mut points = Vec::new();
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|corner| mesh.vertices[corner as usize].cast::<f64>());
        let longest = [b - a, c - b, a - c].map(|side| side.norm()).into_iter().fold(0.0, f64::max);
        let steps = (longest / 0.01).ceil().max(1.0) as usize;
        for i in 0..=steps {
            for j in 0..=steps - i {
                let [u, v] = [i, j].map(|step| step as f64 / steps as f64);
                points.push(a + u * (b - a) + v * (c - a));
            }
        }
    }
    points
}

static SURFACES: LazyLock<Vec<Vec<Point3<f64>>>> = LazyLock::new(|| {
    let mesh = |link| link_mesh(link, Prefer::Visual).unwrap().unwrap();
    ARM.robot().links.iter().map(|link| sampled(&mesh(link))).collect()
});

/// How many joints, moving or not, are between two links.
fn joints_between(a: usize, b: usize) -> usize {
    let to_root = |link: usize| {
        let above = |at: &usize| ARM.robot().links[*at].parent.map(|(parent, _)| parent);
        std::iter::successors(Some(link), above).collect::<Vec<usize>>()
    };
    let (a, b) = (to_root(a), to_root(b));
    let common = a.iter().filter(|link| b.contains(link)).count();
    a.len() + b.len() - 2 * common
}

/// The least distance of the links from each other and of the moving ones from the table, metres.
fn clearance_m(joints: &JointPositions) -> f64 {
    let poses = ARM.link_poses(joints).unwrap();
    let placed = shapes::arm(joints);
    let mut least = f64::INFINITY;
    for (link, surface) in SURFACES.iter().enumerate() {
        // Links with a joint or two between them are shaped to meet.
        let far: Vec<&Placed> =
            placed.iter().filter(|other| joints_between(link, other.link.unwrap()) > 2).collect();
        for point in surface {
            let point = poses[link].unwrap().point(point);
            let others = far.iter().map(|other| other.distance_m(&point));
            let table = if link == ARM.base() { f64::INFINITY } else { point.z };
            least = others.fold(least.min(table), f64::min);
        }
    }
    least
}

#[test]
fn the_arm_touches_neither_itself_nor_the_table() {
    for (joints, _) in CHOSEN.iter() {
        let clearance_m = clearance_m(joints);
        assert!(clearance_m > 0.008, "{clearance_m} m: {joints:?}");
    }
}

#[test]
fn touching_is_noticed() {
    let folded = [0.0, 1.7, 0.0, -3.0, 0.0, 0.0, 0.0];
    let named = folded.iter().zip(1..).map(|(q, n)| (format!("joint{n}"), *q));
    let joints = named.chain([("finger_joint1".to_owned(), 0.0)]).collect();
    assert!(clearance_m(&joints) < 0.0);
}

#[test]
fn the_whole_hand_is_in_sight() {
    const STEP: usize = 2;
    let camera = SENSOR.camera();
    let hand = ARM.end_effector_links();
    for (joints, base_from_camera) in CHOSEN.iter() {
        let poses = ARM.link_poses(joints).unwrap();
        let points = hand.iter().flat_map(|link| {
            let in_base = |point| poses[*link].unwrap().point(point);
            SURFACES[*link].iter().map(in_base)
        });
        let pixels = points.map(|point| {
            let pixel = camera.project(&base_from_camera.inverse().point(&point)).unwrap();
            assert!(camera.contains(&pixel), "{pixel}");
            pixel
        });
        let (mut low, mut high) = (Point2::new(f64::MAX, f64::MAX), Point2::origin());
        pixels.for_each(|pixel| (low, high) = (low.inf(&pixel), high.sup(&pixel)));
        let placed = shapes::arm(joints);
        let rows = (low.y as usize..=high.y as usize).step_by(STEP);
        let columns = || (low.x as usize..=high.x as usize).step_by(STEP);
        let around = rows.flat_map(|v| columns().map(move |u| Point2::new(u as f64, v as f64)));
        let of_hand = around.filter(|pixel| {
            let seen = seen(&placed, &camera, base_from_camera, pixel);
            seen.is_some_and(|(_, shape)| hand.contains(&placed[shape].link.unwrap()))
        });
        let pixels = of_hand.count() * STEP * STEP;
        assert!(pixels > 120, "{pixels} pixels: {joints:?}");
    }
}

#[track_caller]
fn assert_same_places(found: &[JointPositions], expected: &[JointPositions]) {
    assert_eq!(found.len(), expected.len());
    let apart = found.iter().zip(expected).map(|(a, b)| apart(a, b)).fold(0.0, f64::max);
    assert!(apart < 2.0 * AS_SAID, "{apart}");
}

/// What is added around the arm, or on its way, leaves its configurations as they are: each kind of
/// choice has random numbers of its own.
#[test]
fn nothing_else_changes_the_configurations() {
    let base = small();
    let resting = |scenario: Scenario<'static>| Recorded::of(scenario).joints();
    let expected = resting(base.clone());
    let mut faulty = base.clone();
    faulty.faults.depth_scale = 1.02;
    faulty.faults.bump = Some([0.01, 0.01]);
    for other in [
        Scenario { clutter: 5, ..base.clone() },
        Scenario { backgrounds: 2, ..base.clone() },
        Scenario { moving_frames: 3, ..base.clone() },
        faulty,
    ] {
        assert_same_places(&resting(other), &expected);
    }
    let more = Scenario { frames: 3, ..base.clone() };
    assert_same_places(&resting(more)[..2], &expected[..2]);
    let another = resting(Scenario { seed: 8, ..base });
    assert!(apart(&another[0], &expected[0]) > 0.01);
}

#[test]
fn a_camera_that_looks_elsewhere_is_an_error_with_a_remedy() {
    let ranges = eyebolt::simulate::Ranges { distance_m: [15.0; 2], ..Default::default() };
    let scenario =
        Scenario { viewpoint: Viewpoint::Within(ranges), sensor: Sensor::KINECT_V1, ..small() };
    let error = plan(scenario, &CACHE).err().unwrap();
    assert!(matches!(error, SimulateError::Unfit { found: 0, wanted: 2, .. }), "{error}");
    assert_eq!(error.input(), Some(Input::PRESET));
    assert!(error.to_string().contains(&Input::DISTANCE.to_string()), "{error}");
}

#[test]
fn no_configurations_make_an_empty_recording() {
    let plan = planned(Scenario { configurations: 0, ..small() });
    assert!(!bytes(&plan).is_empty());
}
