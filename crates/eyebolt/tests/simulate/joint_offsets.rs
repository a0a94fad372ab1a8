//! Arms whose joints are not where they say.

use crate::stage::{ARM, CACHE, Recorded, planned, preset, small};
use eyebolt::answer::Answer;
use eyebolt::calibrate::{Reason, Verdict};
use eyebolt::evaluate::Evaluation;
use eyebolt::pipeline;
use eyebolt::record::{RecordOptions, observe};
use eyebolt::simulate::{Faults, Scenario};
use eyebolt_geometry::{Base, Transform};
use eyebolt_registration::JointOffsets;
use eyebolt_render::Sensor;
use eyebolt_robot::JointPositions;
use nalgebra::{UnitQuaternion, Vector3};

fn scenario(name: &str, seed: u64, faults: Faults) -> Scenario<'static> {
    let (sensor, viewpoint) = (Sensor::KINECT_V1, preset(name));
    let counts = Scenario { configurations: 5, frames: 3, backgrounds: 3, ..small() };
    Scenario { sensor, viewpoint, seed, faults, ..counts }
}

/// The found offset of each joint is the one that was put in, and the answer is off by no more than
/// it says. The base is the one that the first joint refers to, so that its offset is no error.
fn assert_honest(name: &str, seed: u64, equal_deg: f64, sigma_deg: f64) {
    let joint_offset = equal_deg.to_radians();
    let joint_offset_sigma = sigma_deg.to_radians();
    let faults = Faults { joint_offset, joint_offset_sigma, ..Faults::default() };
    let plan = planned(scenario(name, seed, faults));
    let recorded = Recorded::of_plan(&plan);
    let request = recorded.request();
    let outcome = pipeline::run(&request, &()).unwrap();
    assert_eq!(outcome.calibration.verdict, Verdict::Trusted);
    let pose = outcome.calibration.camera_from_base.unwrap();
    let off = Evaluation::of(&pose, &recorded.truth.camera_from_base);
    let answer = Answer::new(&request, &outcome);
    let expected = answer.expected_error.unwrap();
    assert!(off.translation_mm < 1.5 && off.rotation_deg < 0.1, "{off:?}");
    assert!(off.translation_mm < 2.0 * expected.translation_mm, "{off:?}, {expected:?}");
    assert!(off.rotation_deg < 2.0 * expected.rotation_deg, "{off:?}, {expected:?}");
    assert_eq!(answer.joint_offsets.len(), 7);
    let notable = answer.notable_joint_offsets();
    assert!(notable.count() >= 1, "{:?}", answer.joint_offsets);
    let truth = plan.joint_offsets();
    for joint in &answer.joint_offsets {
        let away_deg = joint.offset_deg - truth[&joint.joint].to_degrees();
        assert!(away_deg.abs() < 4.0 * joint.sigma_deg, "{away_deg} of {joint:?}");
    }
    let shoulder = &answer.joint_offsets[1];
    assert!(shoulder.sigma_deg < 0.15, "{shoulder:?}");
    assert!(answer.end_effector_off_by_joints_mm.unwrap() > 0.5);
}

#[test]
fn a_joint_that_is_off_by_degrees_is_anothers() {
    let faults = Faults { joint_offset: 5.0_f64.to_radians(), ..Faults::default() };
    let recorded = Recorded::of(scenario("paper-test-p2", 1, faults));
    let verdict = pipeline::run(&recorded.request(), &()).unwrap().calibration.verdict;
    let Verdict::Refused(reasons) = verdict else { panic!("joints 5 degrees off are trusted") };
    let is_joint_off = |reason: &Reason| matches!(reason, Reason::JointOff { .. });
    assert!(reasons.iter().any(is_joint_off), "{reasons:?}");
}

#[test]
fn from_the_right_joints_that_are_off_are_found() {
    assert_honest("paper-test-p1", 1, 0.3, 0.0);
}

#[test]
fn from_the_front_joints_that_are_off_are_found() {
    assert_honest("paper-test-p2", 2, 0.0, 0.3);
}

#[test]
fn from_the_left_joints_that_are_off_are_found() {
    assert_honest("paper-test-p3", 3, 0.5, 0.2);
}

/// The joints of observations move its links as the joints of the robot do.
#[test]
fn moved_joints_put_the_links_where_the_robot_has_them() {
    let recorded = Recorded::of(small());
    let observations =
        observe(recorded.recording.source(), &ARM, &CACHE, &RecordOptions::default()).unwrap();
    let names: Vec<_> = observations.arm.joints().iter().map(|joint| joint.name.clone()).collect();
    assert_eq!(names, ARM.required_joints());
    let mut offsets = JointOffsets::default();
    for (joint, rad) in offsets.rad.iter_mut().enumerate().take(names.len()) {
        *rad = 0.05 * (joint as f64 - 2.5);
    }
    let frame = recorded.recording.frame_names();
    for configuration in &observations.configurations {
        let posture = configuration.posture.moved(&observations.arm, &offsets);
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
        let links = observations.arm.links().iter().zip(posture.base_from_link());
        for (link, pose) in links {
            let index = ARM.robot().link_index(&link.name).unwrap();
            // As forward kinematics has it, from a base that is turned by the first joint's offset.
            let base = Transform::<Base, Base>::from_parts(
                Vector3::zeros(),
                UnitQuaternion::from_axis_angle(&Vector3::z_axis(), offsets.rad[0]),
            );
            let (metres, radians) = poses[index].unwrap().distance_to(&(base * *pose));
            assert!(metres < 1e-9 && radians < 1e-7, "{}: {metres} m, {radians}", link.name);
        }
    }
}
