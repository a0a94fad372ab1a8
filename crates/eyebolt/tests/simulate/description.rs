//! Faults of the description, of the motion and of the view.

use crate::stage::{ARM, CACHE, SENSOR, planned, small};
use eyebolt::simulate::{Faults, Plan, Scenario, TrueView};
use eyebolt_recording::FrameSource;
use eyebolt_robot::JointPositions;

fn with(faults: Faults) -> Scenario<'static> {
    Scenario { faults, frames: 1, ..small() }
}

fn joints(plan: &Plan<'_>) -> Vec<JointPositions> {
    let memory = plan.in_memory().unwrap();
    (0..memory.frame_names().len()).map(|frame| memory.read_joints(frame).unwrap()).collect()
}

#[test]
fn a_longer_link_puts_the_hand_as_much_farther() {
    for (seed, link_length_m) in [(7, 0.01), (8, 0.004), (9, -0.003)] {
        let faults = Faults { link_length_m, ..Faults::default() };
        let plan = planned(Scenario { seed, configurations: 1, ..with(faults) });
        let described = ARM.base_from_end_effector(&joints(&plan)[0]).unwrap().translation_m();
        let off = (plan.workspace_in_base().coords - described).norm();
        assert!((off - link_length_m.abs()).abs() < 1e-9, "{off}");
    }
    let right = planned(Scenario { configurations: 1, ..with(Faults::default()) });
    let described = ARM.base_from_end_effector(&joints(&right)[0]).unwrap().translation_m();
    assert!((right.workspace_in_base().coords - described).norm() < 1e-12);
}

#[test]
fn a_lower_base_puts_all_that_moves_as_much_higher() {
    for base_lower_m in [0.05, 0.005, -0.02] {
        let faults = Faults { base_lower_m, ..Faults::default() };
        let plan = planned(Scenario { configurations: 1, ..with(faults) });
        let described = ARM.base_from_end_effector(&joints(&plan)[0]).unwrap().translation_m();
        let off = plan.workspace_in_base().coords - described;
        assert!((off - base_lower_m * nalgebra::Vector3::z()).norm() < 1e-9, "{off}");
    }
}

#[test]
fn a_wrist_that_moves_alone_leaves_the_rest_of_the_arm() {
    let faults = Faults { wrist_only: true, ..Faults::default() };
    let plan = planned(Scenario { configurations: 4, ..with(faults) });
    let joints = joints(&plan);
    let names = ARM.required_joints();
    let at = |frame: usize, name: &str| joints[frame].get(name).unwrap();
    for name in &names[..4] {
        assert!((1..4).all(|frame| at(frame, name) == at(0, name)), "{name}");
    }
    let moved =
        |frame: usize| names[4..].iter().map(move |name| (at(frame, name) - at(0, name)).abs());
    assert!((1..4).all(|frame| moved(frame).fold(0.0, f64::max) > 0.2));
}

#[test]
fn a_box_hides_about_as_much_as_is_asked_for() {
    let arm_pixels = |plan: &Plan<'_>| -> f64 {
        let views = (0..3).map(|index| plan.true_view(index));
        let of_arm =
            |view: TrueView| view.label.iter().filter(|l| **l != TrueView::BACKGROUND).count();
        views.map(of_arm).sum::<usize>() as f64
    };
    let scenario = |occlusion: f64, seed: u64| Scenario {
        configurations: 3,
        seed,
        ..with(Faults { occlusion, ..Faults::default() })
    };
    for seed in [7, 8] {
        let (open, hidden) = (planned(scenario(0.0, seed)), planned(scenario(0.33, seed)));
        assert_eq!(hidden.solids().last().unwrap().name, "occluder");
        let share = 1.0 - arm_pixels(&hidden) / arm_pixels(&open);
        assert!((0.15..0.55).contains(&share), "{share}");
    }
}

#[test]
fn one_joint_is_off_and_it_is_not_the_first() {
    let faults = Faults { one_joint_offset: 0.03, ..Faults::default() };
    let mut off = std::collections::BTreeSet::new();
    for seed in 0..12 {
        let scenario = Scenario { seed, configurations: 1, sensor: SENSOR, ..with(faults) };
        let Ok(plan) = eyebolt::simulate::plan(scenario, &CACHE) else { continue };
        let offsets = plan.joint_offsets();
        let wrong: Vec<&String> = offsets.keys().filter(|name| offsets[*name] != 0.0).collect();
        assert_eq!(wrong.len(), 1);
        assert!((offsets[wrong[0]].abs() - 0.03).abs() < 1e-12);
        assert_ne!(wrong[0], "joint1");
        off.insert(wrong[0].clone());
    }
    assert!(off.len() > 2, "the seed decides which: {off:?}");
}
