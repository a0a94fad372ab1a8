//! Recordings that do not tell the pose, or tell it in part.

use crate::recording::write_depth;
use crate::run::{MASKED, Ran, UNMASKED, WITH_MASKS, WITHOUT_MASKS, folder, run, run_depth, truth};
use crate::scene::{JOINT_NAMES, JOINTS, Shot, shot, shots};
use eyebolt::calibrate::{Reason, Verdict};
use eyebolt::refine::Dropped;
use std::fs;

fn reasons(ran: &Ran) -> &[Reason] {
    match ran.verdict() {
        Verdict::Refused(reasons) => reasons,
        Verdict::Trusted => panic!("trusted"),
    }
}

#[test]
fn one_configuration_again_and_again_is_refused() {
    let frames: Vec<Shot> = (1..6).map(|seed| shot(JOINTS[0], seed)).collect();
    for options in [WITH_MASKS, WITHOUT_MASKS] {
        let ran = run_depth(&frames, options);
        let few = |reason: &Reason| matches!(reason, Reason::FewConfigurations { needed: 3, .. });
        assert!(reasons(&ran).iter().any(few), "{:?}", ran.verdict());
        assert!(ran.answer.configurations.iter().all(|frame| frame.configuration == 0));
    }
}

#[test]
fn joints_under_the_names_of_others_are_refused() {
    let folder = folder();
    write_depth(folder.path(), &shots());
    let path = folder.path().join("recording.toml");
    let mut names = JOINT_NAMES;
    names.rotate_left(1);
    let text = fs::read_to_string(&path).unwrap();
    let permuted = text.replace(&format!("{JOINT_NAMES:?}"), &format!("{names:?}"));
    assert_ne!(permuted, text);
    fs::write(&path, permuted).unwrap();
    for options in [WITH_MASKS, WITHOUT_MASKS] {
        let ran = run(folder.path(), options);
        let misplaced = |reason: &Reason| matches!(reason, Reason::Misplaced { .. });
        assert!(reasons(&ran).iter().any(misplaced), "{:?}", ran.verdict());
    }
}

#[test]
fn a_frame_whose_joints_are_not_those_seen_does_no_harm() {
    let mut frames = shots();
    // The elbow was elsewhere when the joints were read.
    frames[2].joints[2] += 0.5;
    for (options, bounds) in [(WITH_MASKS, MASKED), (WITHOUT_MASKS, UNMASKED)] {
        let ran = run_depth(&frames, options);
        ran.assert_trusted(&truth(), bounds);
        let outcomes = ran.outcome.calibration.configurations.iter();
        let dropped: Vec<_> = outcomes.map(|outcome| &outcome.dropped).collect();
        assert!(matches!(dropped[2], Some(Dropped::Misplaced(_))), "{dropped:?}");
        assert!(dropped.iter().enumerate().all(|(i, dropped)| i == 2 || dropped.is_none()));
        let reason = ran.answer.configurations[2].reason.as_deref().unwrap();
        assert!(
            reason.contains("sees through") && reason.contains("not where its joints put it"),
            "{reason}"
        );
    }
}
