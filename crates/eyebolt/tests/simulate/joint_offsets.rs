//! Arms whose joints are not where they say.

use crate::stage::{ARM, CACHE, Recorded, preset, small};
use eyebolt::answer::Answer;
use eyebolt::calibrate::{Limits, Verdict};
use eyebolt::evaluate::Evaluation;
use eyebolt::pipeline::{self, Request};
use eyebolt::record::{self, RecordOptions};
use eyebolt::simulate::Scenario;
use eyebolt_registration::{JointOffsets, MOST_JOINTS};
use eyebolt_render::Sensor;
use eyebolt_robot::JointPositions;

const OFFSET_DEG: f64 = 0.3;

fn recorded(name: &str, seed: u64) -> Recorded {
    let mut scenario = Scenario {
        sensor: Sensor::KINECT_V1,
        viewpoint: preset(name),
        configurations: 5,
        frames: 3,
        backgrounds: 3,
        seed,
        ..small()
    };
    scenario.faults.joint_offset = OFFSET_DEG.to_radians();
    Recorded::of(scenario)
}

/// Of all joints that are surely off, the found offset is the one that was put in; and the answer is
/// off by no more than it says.
fn assert_honest(name: &str, seed: u64) {
    let recorded = recorded(name, seed);
    let request = Request {
        recording: &recorded.recording,
        arm: &ARM,
        cache: &CACHE,
        options: RecordOptions::default(),
        limits: Limits::default(),
        seed: 1,
    };
    let outcome = pipeline::run(&request, &()).unwrap();
    assert_eq!(outcome.calibration.verdict, Verdict::Trusted);
    let pose = outcome.calibration.camera_from_base.unwrap();
    let off = Evaluation::of(&pose, &recorded.truth.camera_from_base);
    let answer = Answer::new(&request, &outcome);
    let expected = answer.expected_error.unwrap();
    assert!(off.translation_mm < 1.5, "{off:?}");
    assert!(off.translation_mm < 2.0 * expected.translation_mm, "{off:?}, {expected:?}");
    assert!(off.rotation_deg < 2.0 * expected.rotation_deg, "{off:?}, {expected:?}");
    assert_eq!(answer.joint_offsets.len(), 7);
    let notable = answer.joint_offsets.iter().filter(|joint| joint.is_notable());
    assert!(notable.clone().count() >= 3, "{:?}", answer.joint_offsets);
    for joint in notable {
        let away_deg = (joint.offset_deg.abs() - OFFSET_DEG).abs();
        assert!(away_deg < 3.0 * joint.sigma_deg.max(0.03), "{joint:?}");
    }
}

#[test]
fn from_the_right_joints_that_are_off_are_found() {
    assert_honest("paper-test-p1", 1);
}

#[test]
fn from_the_front_joints_that_are_off_are_found() {
    assert_honest("paper-test-p2", 2);
}

#[test]
fn from_the_left_joints_that_are_off_are_found() {
    assert_honest("paper-test-p3", 3);
}

/// The joints of a session move its links as the joints of the robot do.
#[test]
fn moved_joints_put_the_links_where_the_robot_has_them() {
    let recorded = Recorded::of(small());
    let mut session =
        record::open(&recorded.recording, &ARM, &CACHE, &RecordOptions::default()).unwrap();
    let names: Vec<_> = session.arm.joints().iter().map(|joint| joint.name.clone()).collect();
    assert_eq!(names, ARM.required_joints());
    let mut offsets = JointOffsets { rad: [0.0; MOST_JOINTS] };
    for (joint, rad) in offsets.rad.iter_mut().enumerate().take(names.len()) {
        *rad = 0.05 * (joint as f64 - 2.5);
    }
    session.move_joints(&offsets);
    let frame = recorded.recording.frame_names();
    for configuration in &session.configurations {
        let at = frame.iter().position(|name| *name == configuration.frames[0]).unwrap();
        let told = recorded.recording.read_joints(at).unwrap();
        let farther: JointPositions = told
            .iter()
            .map(|(name, position)| {
                let joint = names.iter().position(|joint| joint == name);
                (name.to_owned(), position + joint.map_or(0.0, |joint| offsets.rad[joint]))
            })
            .collect();
        let poses = ARM.link_poses(&farther).unwrap();
        let links = session.arm.links().iter().zip(configuration.posture.base_from_link());
        for (link, pose) in links {
            let index = ARM.robot().link_index(&link.name).unwrap();
            let (metres, radians) = poses[index].unwrap().distance_to(pose);
            assert!(metres < 1e-9 && radians < 1e-7, "{}: {metres} m, {radians}", link.name);
        }
    }
}
