//! What must not be trusted.

use crate::recording::{JOINTS, Variant, shared};
use eyebolt::calibrate::{Reason, Verdict};

#[track_caller]
fn reasons(variant: &Variant, shared: &std::path::Path) -> Vec<Reason> {
    match variant.open(shared).run().calibration.verdict {
        Verdict::Refused(reasons) => reasons,
        Verdict::Trusted => panic!("trusted with joints {:?}", variant.joints),
    }
}

#[test]
fn one_configuration_repeated_five_times() {
    let Some(shared) = shared() else { return };
    for masks in [true, false] {
        let variant = Variant { frames: vec![2; 5], masks, ..Variant::default() };
        let reasons = reasons(&variant, &shared);
        let few = |reason: &Reason| matches!(reason, Reason::FewConfigurations { .. });
        assert!(reasons.iter().any(few), "{reasons:?}");
    }
}

#[test]
fn any_two_joint_names_exchanged() {
    let Some(shared) = shared() else { return };
    for a in 0..JOINTS.len() {
        for b in a + 1..JOINTS.len() {
            let mut joints = JOINTS.map(str::to_owned).to_vec();
            joints.swap(a, b);
            for masks in [true, false] {
                reasons(&Variant { joints: joints.clone(), masks, ..Variant::default() }, &shared);
            }
        }
    }
}

#[test]
fn joint_names_in_reverse_or_shifted() {
    let Some(shared) = shared() else { return };
    let mut reversed = JOINTS.map(str::to_owned).to_vec();
    reversed.reverse();
    let mut shifted = JOINTS.map(str::to_owned).to_vec();
    shifted.rotate_left(1);
    for joints in [reversed, shifted] {
        reasons(&Variant { joints, ..Variant::default() }, &shared);
    }
}

const PANDA: [&str; 3] = ["data/robots/panda/panda_hand.urdf", "panda_link0", "panda_hand"];

#[test]
fn another_robot_with_other_joint_names() {
    let Some(shared) = shared() else { return };
    let reasons = reasons(&Variant { robot: PANDA, ..Variant::default() }, &shared);
    assert!(matches!(&reasons[..], [Reason::OtherRobot { .. }]), "{reasons:?}");
}

#[test]
fn another_robot_whatever_its_joints_are_called() {
    let Some(shared) = shared() else { return };
    let joints: Vec<String> = (1..=7).map(|joint| format!("panda_joint{joint}")).collect();
    for masks in [true, false] {
        reasons(
            &Variant { robot: PANDA, joints: joints.clone(), masks, ..Variant::default() },
            &shared,
        );
    }
}
