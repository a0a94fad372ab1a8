//! What goes wrong on purpose goes wrong where it should, and nowhere else.

use crate::stage::{ARM, AS_SAID, CACHE, Recorded, SENSOR, apart, assert_same, planned, small};
use eyebolt::simulate::{Faults, Lab, Scenario, SecondArm, SimulateError, plan};
use eyebolt_robot::{Input, JointPositions};
use nalgebra::Vector3;
use serde_json::json;
use std::sync::LazyLock;

fn scenario(faults: Faults) -> Scenario<'static> {
    Scenario { configurations: 3, frames: 1, faults, ..small() }
}

fn recorded(faults: Faults) -> Recorded {
    Recorded::of(scenario(faults))
}

static RIGHT: LazyLock<Recorded> = LazyLock::new(|| recorded(Faults::default()));

/// What `joints` say beyond what is right, joint by joint in the order of the arm.
fn beyond(joints: &JointPositions, right: &JointPositions) -> Vec<f64> {
    let names = ARM.required_joints();
    names.iter().map(|name| joints.get(name).unwrap() - right.get(name).unwrap()).collect()
}

#[test]
fn joint_offsets_are_in_what_the_joints_say_alone() {
    let joint_offset = 0.02;
    let wrong = recorded(Faults { joint_offset, ..Faults::default() });
    let mut offsets = Vec::new();
    for (frame, (joints, right)) in wrong.joints().iter().zip(RIGHT.joints()).enumerate() {
        assert_eq!(wrong.depth(frame), RIGHT.depth(frame));
        assert_eq!(joints.get("finger_joint1"), right.get("finger_joint1"));
        offsets.push(beyond(joints, &right));
    }
    for offset in &offsets {
        assert!(offset.iter().all(|offset| (offset.abs() - joint_offset).abs() < 1e-9));
        let same = offset.iter().zip(&offsets[0]).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(same, "an encoder is off by the same everywhere");
    }
    assert!(offsets[0].iter().any(|o| *o > 0.0) && offsets[0].iter().any(|o| *o < 0.0));
    // The base that the joints speak of is turned about the first joint's axis, which is the base's z.
    let turned = RIGHT.truth.camera_from_base.inverse() * wrong.truth.camera_from_base;
    let first = ARM.required_joints()[0];
    let told = wrong.joints()[0].get(first).unwrap() - RIGHT.joints()[0].get(first).unwrap();
    let expected = Vector3::new(0.0, 0.0, -told);
    assert!((turned.rotation().scaled_axis() - expected).norm() < 1e-9, "{turned:?}");
    assert!(turned.translation_m().norm() < 1e-9, "{turned:?}");
}

/// Joints lag behind: those that came from below are not yet where they say.
#[test]
fn backlash_has_the_sign_of_the_way() {
    let backlash = 0.03;
    let wrong = recorded(Faults { backlash, ..Faults::default() });
    let (wrong, right) = (wrong.joints(), RIGHT.joints());
    assert!(apart(&wrong[0], &right[0]) < 2.0 * AS_SAID, "it came from nowhere");
    for at in 1..3 {
        let came = beyond(&right[at], &right[at - 1]);
        for (said, came) in beyond(&wrong[at], &right[at]).iter().zip(came) {
            let lag = 0.5 * backlash * came.signum();
            assert!((said - lag).abs() < 2.0 * AS_SAID, "{said} after {came}");
        }
        let finger = |joints: &JointPositions| joints.get("finger_joint1").unwrap();
        assert!((finger(&wrong[at]) - finger(&right[at])).abs() < 2.0 * AS_SAID);
    }
}

#[test]
fn depth_is_scaled_and_shifted_backgrounds_too() {
    let faults = Faults { depth_scale: 1.03, depth_offset_m: -0.02, ..Faults::default() };
    let wrong = Recorded::of(Scenario { backgrounds: 1, ..scenario(faults) });
    let right = Recorded::of(Scenario { backgrounds: 1, ..scenario(Faults::default()) });
    let background = |recorded: &Recorded| recorded.recording.read_background(0).unwrap();
    let frames = (0..3).map(|frame| (wrong.depth(frame), right.depth(frame)));
    for (wrong, right) in frames.chain([(background(&wrong), background(&right))]) {
        for (wrong, right) in wrong.depth_m().iter().zip(right.depth_m()) {
            assert!((wrong - (1.03 * right - 0.02)).abs() < 2e-6, "{wrong} {right}");
        }
    }
    assert_eq!(wrong.joints(), right.joints());
}

#[test]
fn only_what_is_stated_of_the_intrinsics_is_wrong() {
    let faults = Faults { focal_scale: 0.98, centre_px: [3.0, -2.0], ..Faults::default() };
    let wrong = recorded(faults);
    let (stated, camera) = (wrong.recording.camera().unwrap(), SENSOR.camera());
    assert!((stated.fx() - 0.98 * camera.fx()).abs() < 1e-9);
    assert!((stated.fy() - 0.98 * camera.fy()).abs() < 1e-9);
    assert!((stated.cx() - camera.cx() - 3.0).abs() < 1e-9);
    assert!((stated.cy() - camera.cy() + 2.0).abs() < 1e-9);
    assert!((0..3).all(|frame| wrong.depth(frame) == RIGHT.depth(frame)));
    for focal_scale in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let scenario = scenario(Faults { focal_scale, ..Faults::default() });
        let error = plan(scenario, &CACHE).err().unwrap();
        assert!(matches!(error, SimulateError::Intrinsics(_)), "{error}");
        assert_eq!(error.input(), Some(Input::FOCAL_SCALE));
        assert!(
            error.to_string().starts_with("argument `focal_scale`, argument `centre`: "),
            "{error}"
        );
    }
}

#[test]
fn a_camera_is_bumped_between_configurations() {
    let bumped = scenario(Faults { bump: Some([0.05, 0.1]), ..Faults::default() });
    let error = plan(Scenario { configurations: 1, ..bumped }, &CACHE).err().unwrap();
    assert_eq!(error.input(), Some(Input::BUMP));
    assert!(error.to_string().contains(&Input::CONFIGURATIONS.to_string()), "{error}");
}

#[test]
fn a_bumped_camera_sees_the_rest_from_another_place() {
    let bump = [0.05, 0.1];
    let plan = planned(Scenario {
        moving_frames: 2,
        frames: 2,
        ..scenario(Faults { bump: Some(bump), ..Faults::default() })
    });
    let bumped = Recorded::of_plan(&plan);
    assert_same(&bumped.truth.camera_from_base, &plan.camera_from_base());
    let [after] = &bumped.truth.camera_from_base_after[..] else { panic!("one bump") };
    let moved = bumped.truth.camera_from_base.inverse();
    let (metres, radians) = moved.distance_to(&after.camera_from_base.inverse());
    assert!((metres - bump[0]).abs() < 1e-9 && (radians - bump[1]).abs() < 1e-9);
    let right = Recorded::of(Scenario { frames: 2, ..scenario(Faults::default()) });
    let poses: Vec<_> = (0..6).map(|frame| bumped.base_from_camera(frame)).collect();
    for frame in 0..6 {
        // Two of three configurations come before: the camera is bumped after half of them.
        assert_eq!(poses[frame] == poses[0], frame < 4);
        assert_eq!(bumped.depth(frame) == right.depth(frame), frame < 4, "frame {frame}");
        assert!(crate::recording::misfit(&plan, &bumped, frame).0 < crate::recording::FLAT_SIDES_M);
    }
}

#[test]
fn faults_are_named_with_their_units() {
    let faults = Faults {
        depth_scale: 1.01,
        depth_offset_m: 0.003,
        focal_scale: 0.99,
        centre_px: [1.0, 2.0],
        joint_offset: 1f64.to_radians(),
        joint_offset_sigma: 0.5f64.to_radians(),
        backlash: 2f64.to_radians(),
        time_skew_s: 0.05,
        one_joint_offset: 1.5f64.to_radians(),
        link_length_m: 0.006,
        base_lower_m: 0.04,
        wrist_only: true,
        occlusion: 0.25,
        bump: Some([0.02, 3f64.to_radians()]),
        lab: Lab {
            gloss: 0.2,
            far_room: true,
            wander_m: 0.01,
            tool_m: 0.1,
            cable: true,
            cover: true,
            passers_by: 2,
            other_rooms: 0.5,
            second_arm: SecondArm::Moving,
            fixed_pattern: 1.5,
        },
    };
    let expected = json!({
        "depth_scale": 1.01, "depth_offset_mm": 3.0, "focal_scale": 0.99, "centre_x_px": 1.0,
        "centre_y_px": 2.0, "joint_offset_deg": 1.0, "joint_offset_sigma_deg": 0.5, "backlash_deg": 2.0,
        "time_skew_ms": 50.0, "bump_mm": 20.0, "bump_deg": 3.0, "one_joint_offset_deg": 1.5,
        "link_length_mm": 6.0, "base_lower_mm": 40.0, "wrist_only": 1.0, "occlusion": 0.25, "gloss": 0.2, "far_room": 1.0,
        "wander_mm": 10.0, "tool_mm": 100.0, "cable": 1.0, "cover": 1.0, "passers_by": 2.0,
        "other_rooms": 0.5, "second_arm_moving": 1.0, "fixed_pattern": 1.5,
    });
    let named = faults.named();
    assert_eq!(named.len(), expected.as_object().unwrap().len());
    for (name, value) in &named {
        let (value, expected) = (value.as_f64().unwrap(), expected[name].as_f64().unwrap());
        assert!((value - expected).abs() < 1e-9, "{name}: {value}");
    }
    assert!(Faults::default().named().is_empty() && RIGHT.truth.faults.is_empty());
    assert_eq!(recorded(faults).truth.faults, named);
}
