//! The hand of the paper.

use crate::gripper::joints;
use eyebolt::end_effector::EndEffector;
use eyebolt_robot::{JointPositions, PackageRoots, Robot};
use nalgebra::{Point3, Vector3};
use std::io::Write;
use std::path::PathBuf;

fn hand() -> Option<EndEffector> {
    let file = "data/robots/panda/panda_hand.urdf";
    let folder = std::env::var_os("EYEBOLT_SHARED").map(PathBuf::from);
    let Some(urdf) = folder.map(|folder| folder.join(file)).filter(|urdf| urdf.is_file()) else {
        // Past the test harness, which would keep it for itself.
        let remedy = "set EYEBOLT_SHARED to the folder of shared data";
        let _ = writeln!(std::io::stderr(), "SKIPPED a test on {file}: {remedy}");
        return None;
    };
    let robot = Robot::from_urdf_file(&urdf, &PackageRoots::new()).unwrap();
    Some(EndEffector::of(&robot.arm(None, Some("panda_hand")).unwrap()).unwrap())
}

/// Method, section 1: reference points with the fingers open, and the printed box.
#[test]
fn a_panda_has_the_keypoints_and_the_box_of_the_paper() {
    let Some(hand) = hand() else { return };
    let open = joints(&[("panda_finger_joint1", 0.04), ("panda_finger_joint2", 0.04)]);
    let printed = [
        [0.0198, 0.0809, 0.0032],
        [0.0217, -0.0899, 0.0039],
        [0.0129, 0.0910, 0.0613],
        [0.0208, -0.0979, 0.0561],
        [-0.0019, 0.0465, 0.1156],
        [0.0024, -0.0426, 0.1156],
    ];
    let found = hand.keypoints(&open);
    assert_eq!(found.len(), printed.len());
    for (found, printed) in found.iter().zip(printed.map(Point3::from)) {
        assert!((found - printed).norm() < 1e-9, "{found} {printed}");
    }
    let about = hand.bounding_box(&open);
    assert_eq!(about.size_m(), Vector3::new(0.10, 0.28, 0.13));
    // The reference points lie near the surface that the URDF describes.
    let surface = hand.points(&open, 20_000);
    for point in &found {
        let away = surface.iter().map(|p| (p - point).norm()).fold(f64::INFINITY, f64::min);
        assert!(away < 0.03, "{point}: {away}");
    }
}

#[test]
fn closing_the_fingers_moves_two_of_them() {
    let Some(hand) = hand() else { return };
    let open = joints(&[("panda_finger_joint1", 0.04), ("panda_finger_joint2", 0.04)]);
    let (open, closed) = (hand.keypoints(&open), hand.keypoints(&JointPositions::default()));
    let moved: Vec<f64> = open.iter().zip(&closed).map(|(a, b)| (a - b).norm()).collect();
    assert!(moved[..4].iter().all(|moved| *moved < 1e-9), "{moved:?}");
    assert!(moved[4..].iter().all(|moved| (moved - 0.04).abs() < 1e-9), "{moved:?}");
}
