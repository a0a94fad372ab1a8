//! Joints that are missing, too many, or in degrees.

use crate::folder::{GOOD, Recorded, SHOTS};
use crate::outcome::{assert_not_calibrated, assert_refused, assert_unusable, trusted};
use crate::run::eyebolt;
use crate::scene::{JOINT_NAMES, JOINTS, Shot, shot};

/// Adds to or takes from the names in the description.
fn rename(recorded: &Recorded, names: &[&str]) {
    recorded.replace("recording.toml", &format!("{JOINT_NAMES:?}"), &format!("{names:?}"));
}

#[test]
fn a_missing_joint() {
    let recorded = Recorded::two();
    rename(&recorded, &JOINT_NAMES[..5]);
    (0..2).for_each(|frame| recorded.write_joints(frame, &JOINTS[frame][..5]));
    let path = recorded.path().to_str().unwrap();
    let words = [path, "frame 0", "arm joint `roll`", "`bend`", "record these joints or use"];
    assert_not_calibrated(recorded.path(), &[], &words);
    let ended = eyebolt(&["info", path]);
    assert_eq!((ended.code, ended.err.as_str()), (Some(3), ""));
    assert!(ended.out.contains("joint roll of the arm is not recorded"), "{}", ended.out);
}

#[test]
fn a_file_with_fewer_positions_than_names() {
    let recorded = Recorded::two();
    recorded.write_joints(1, &JOINTS[1][..5]);
    let words = ["joints_1.npy: joints", "5 positions", "6 names", "joint_names in recording.toml"];
    assert_unusable(recorded.path(), &words);
}

/// As of a gripper, or a second arm: nothing bad.
#[test]
fn a_joint_that_the_robot_does_not_have() {
    let recorded = Recorded::all();
    rename(&recorded, &[&JOINT_NAMES[..], &["gripper"]].concat());
    for (frame, shot) in SHOTS.iter().enumerate() {
        recorded.write_joints(frame, &[&shot.joints[..], &[0.3]].concat());
    }
    assert_eq!(trusted(recorded.path()), *GOOD);
    let ended = eyebolt(&["info", recorded.path().to_str().unwrap()]);
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""));
    assert!(ended.out.contains("not of this robot: gripper"), "{}", ended.out);
}

#[test]
fn degrees_beyond_what_any_joint_turns() {
    let recorded = Recorded::two();
    recorded.write_joints(1, &JOINTS[1].map(f64::to_degrees));
    let words = ["joints_1.npy: joints", "turn is -51.566", "looks like degrees", "Store radians"];
    assert_unusable(recorded.path(), &words);
}

/// Near their zeros, joints in degrees are numbers that a joint in radians could have.
#[test]
fn degrees_that_the_limits_of_the_joints_do_not_allow() {
    let small = [
        [0.15, -0.20, 0.10, 0.05, 0.12, 0.08],
        [-0.18, 0.11, -0.14, -0.15, 0.21, -0.12],
        [0.04, 0.17, 0.18, 0.20, -0.10, 0.19],
    ];
    let frames = small.iter().zip(1..).map(|(joints, seed)| shot(*joints, seed));
    let in_degrees = |shot: Shot| Shot { joints: shot.joints.map(f64::to_degrees), ..shot };
    let recorded = Recorded::of(&frames.map(in_degrees).collect::<Vec<_>>());
    let worst = ["joint bend is at 12.032 rad in frame 1", "-2.200 to 2.200", "store radians if"];
    assert_refused(recorded.path(), &worst);
}

/// The joints of another moment, or a limit of another robot.
#[test]
fn a_joint_that_is_hardly_outside_its_limits() {
    let recorded = Recorded::all();
    recorded.replace("arm.urdf", "lower=\"-2.6\" upper=\"2.6\"", "lower=\"-2.6\" upper=\"1.79\"");
    let worst = ["joint elbow is at 1.900 rad in frame 3", "-2.600 to 1.790", "joint names"];
    assert_refused(recorded.path(), &worst);
    // Limits and zeros of real arms are not that exact.
    recorded.replace("arm.urdf", "upper=\"1.79\"", "upper=\"1.81\"");
    trusted(recorded.path());
}
