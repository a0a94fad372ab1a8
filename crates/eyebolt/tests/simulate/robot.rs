//! The built-in robot is a Panda but for its shape.

use crate::stage::{ARM, shackle};
use eyebolt::robots::BUILT_IN;
use eyebolt_render::Random;
use eyebolt_robot::{Arm, JointPositions, PackageRoots, Prefer, Robot, link_mesh};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use std::io::Write;

#[test]
fn every_link_of_every_robot_has_a_shape_and_needs_no_file() {
    for (robot, joints) in BUILT_IN.iter().zip([7, 6, 7, 5]) {
        let arm = robot.arm();
        for link in &arm.robot().links {
            let mesh = link_mesh(link, Prefer::Visual).unwrap();
            let mesh = mesh.unwrap_or_else(|| panic!("{} has no shape", link.name));
            let (low, high) = mesh.bounds().unwrap();
            assert!((high - low).min() > 0.005 && (high - low).max() < 0.6, "{}", link.name);
        }
        assert!(!robot.urdf.contains("filename"));
        assert_eq!(robot.name, arm.robot().name);
        assert_eq!(arm.required_joints().len(), joints);
    }
    assert_eq!(shackle().name, ARM.robot().name);
}

/// No posture of many reaches farther than stated, and some reach nearly as far.
#[test]
fn robots_reach_as_far_as_is_stated() {
    for robot in BUILT_IN {
        let (arm, reach_m) = (robot.arm(), robot.about().reach_m);
        let mut random = Random::new(5);
        let mut reach = || {
            let limits = |name: &&str| {
                let robot = arm.robot();
                let joint = &robot.joints[robot.joint_index(name).unwrap()];
                let limits = joint.limits.unwrap();
                ((*name).to_owned(), random.between(limits.lower, limits.upper))
            };
            let joints: JointPositions = arm.required_joints().iter().map(limits).collect();
            let first =
                &arm.robot().joints[arm.robot().joint_index(arm.required_joints()[0]).unwrap()];
            let shoulder = first.parent_from_child_at_zero.translation_m();
            (arm.base_from_end_effector(&joints).unwrap().translation_m() - shoulder).norm()
        };
        let farthest = (0..20_000).map(|_| reach()).fold(0.0, f64::max);
        assert!((0.8..1.2).contains(&(farthest / reach_m)), "{}: {farthest}", robot.name);
    }
}

/// Joint positions that any of its joints can have: `joint1` and so on, after `prefix`.
fn any_joints(random: &mut Random, prefix: &str) -> (Vec<f64>, JointPositions) {
    let values: Vec<f64> = (0..7).map(|_| random.between(-2.8, 2.8)).collect();
    let named = values.iter().zip(1..).map(|(q, n)| (format!("{prefix}joint{n}"), *q));
    let finger = (format!("{prefix}finger_joint1"), random.between(0.0, 0.04));
    let joints = named.chain([finger]).collect();
    (values, joints)
}

/// Rows of Craig's parameters: a, d and alpha of each joint, as Franka Robotics publishes them.
/// <https://frankarobotics.github.io/docs/control_parameters.html#denavithartenberg-parameters>
const CRAIG: [[f64; 3]; 7] = [
    [0.0, 0.333, 0.0],
    [0.0, 0.0, -FRAC_PI_2],
    [0.0, 0.316, FRAC_PI_2],
    [0.0825, 0.0, FRAC_PI_2],
    [-0.0825, 0.384, -FRAC_PI_2],
    [0.0, 0.0, FRAC_PI_2],
    [0.088, 0.0, FRAC_PI_2],
];
/// From the last joint to the flange along z, and the turn of the hand on it.
const FLANGE_M: f64 = 0.107;
const HAND: f64 = -FRAC_PI_4;

/// Where a link is from the one before it: about x, along x, about z, along z.
fn craig([a, d, alpha]: [f64; 3], theta: f64) -> Isometry3<f64> {
    let about = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
    let x = Isometry3::from_parts(Translation3::new(a, 0.0, 0.0), about(Vector3::x_axis(), alpha));
    x * Isometry3::from_parts(Translation3::new(0.0, 0.0, d), about(Vector3::z_axis(), theta))
}

#[test]
fn its_kinematics_are_the_published_table() {
    let mut random = Random::new(11);
    for _ in 0..200 {
        let (values, joints) = any_joints(&mut random, "");
        let poses = ARM.link_poses(&joints).unwrap();
        let assert_at = |name: &str, expected: &Isometry3<f64>| {
            let found = poses[ARM.robot().link_index(name).unwrap()].unwrap();
            assert_same(found.isometry(), expected, name);
        };
        let mut link = Isometry3::identity();
        for (index, row) in CRAIG.iter().enumerate() {
            link *= craig(*row, values[index]);
            assert_at(&format!("link{}", index + 1), &link);
        }
        link *= craig([0.0, FLANGE_M, 0.0], HAND);
        assert_at("hand", &link);
        assert_same(ARM.base_from_end_effector(&joints).unwrap().isometry(), &link, "hand");
    }
}

#[test]
fn its_kinematics_and_limits_are_the_pandas() {
    let Some(panda) = panda() else { return };
    let pairs = (0..8).map(|n| (format!("link{n}"), format!("panda_link{n}"))).chain([
        ("hand".to_owned(), "panda_hand".to_owned()),
        ("left_finger".to_owned(), "panda_leftfinger".to_owned()),
        ("right_finger".to_owned(), "panda_rightfinger".to_owned()),
    ]);
    let pairs: Vec<(String, String)> = pairs.collect();
    for seed in 0..100 {
        let (_, ours) = any_joints(&mut Random::new(seed), "");
        let (_, theirs) = any_joints(&mut Random::new(seed), "panda_");
        let (ours, theirs) = (ARM.link_poses(&ours).unwrap(), panda.link_poses(&theirs).unwrap());
        for (our, their) in &pairs[..pairs.len() - 1] {
            let our_pose = ours[ARM.robot().link_index(our).unwrap()].unwrap();
            let their_pose = theirs[panda.robot().link_index(their).unwrap()].unwrap();
            assert_same(our_pose.isometry(), their_pose.isometry(), our);
        }
        // The Panda's right finger is turned about; ours is not: only where it is counts.
        let (our, their) = &pairs[pairs.len() - 1];
        let our_pose = ours[ARM.robot().link_index(our).unwrap()].unwrap();
        let their_pose = theirs[panda.robot().link_index(their).unwrap()].unwrap();
        assert!((our_pose.translation_m() - their_pose.translation_m()).norm() < 1e-9);
    }
    for name in ARM.required_joints().into_iter().chain(["finger_joint1"]) {
        let limits = |arm: &Arm, name: &str| {
            let robot = arm.robot();
            robot.joints[robot.joint_index(name).unwrap()].limits.unwrap()
        };
        let (ours, theirs) = (limits(&ARM, name), limits(&panda, &format!("panda_{name}")));
        assert!(ours.lower >= theirs.lower && ours.upper <= theirs.upper, "{name}: {theirs:?}");
    }
}

fn assert_same(a: &Isometry3<f64>, b: &Isometry3<f64>, what: &str) {
    let apart = (a.to_homogeneous() - b.to_homogeneous()).amax();
    assert!(apart < 1e-9, "{what}: {apart}");
}

/// The Panda of the shared data, or `None` said loudly.
fn panda() -> Option<Arm> {
    let root = std::env::var_os("EYEBOLT_SHARED").map(std::path::PathBuf::from);
    let path = root.map(|root| root.join("data/robots/panda/panda_hand.urdf"));
    let Some(path) = path.filter(|path| path.is_file()) else {
        // Past the test harness, which would keep it for itself.
        let remedy = "set EYEBOLT_SHARED to the folder of shared data";
        let _ = writeln!(std::io::stderr(), "SKIPPED a test against the Panda's URDF: {remedy}");
        return None;
    };
    let robot = Robot::from_urdf_file(&path, &PackageRoots::new()).unwrap();
    Some(robot.arm(Some("panda_link0"), Some("panda_hand")).unwrap())
}
