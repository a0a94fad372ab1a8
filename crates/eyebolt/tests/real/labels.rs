//! Labels of real frames, made without masks, against the masks.

use crate::others::XARM;
use crate::recording::{Opened, Variant, shared, shared_with};
use eyebolt::answer::Answer;
use eyebolt::dataset::LabelRun;
use eyebolt::end_effector::EndEffector;
use eyebolt::export::SavedCalibration;
use eyebolt::pipeline::run;
use eyebolt_registration::{Label, Labels};

/// Masks are not to be trusted at their edges, pixels.
const EDGE_PX: f32 = 3.0;

/// Calibrates without masks, labels every frame, and compares where the mask is sure.
fn assert_right(opened: &Opened) {
    let request = opened.request();
    let outcome = run(&request, &()).unwrap();
    let answer = Answer::new(&request, &outcome).to_json();
    let calibration = SavedCalibration::parse("calibration.json", &answer).unwrap();
    let hand = EndEffector::of(request.arm).unwrap();
    let observations = outcome.observations.as_ref().unwrap();
    let parts = (observations, &request.options);
    let run = LabelRun::new(request.source, parts, (request.arm, &hand), &calibration).unwrap();
    let (mut robot, mut rest) = ([0_usize; 2], [0_usize; 2]);
    for index in 0..request.source.frame_names().len() {
        let labelled = run.frame(index).unwrap().unwrap().frame;
        let mask = request.source.read_frame(index).unwrap().mask.unwrap();
        let masked =
            Labels::from_fn(0..mask.width() as usize, 0..mask.height() as usize, |u, v| {
                if mask.at(u as u32, v as u32) { Label::Arm } else { Label::Background }
            });
        let near_robot = masked.near(EDGE_PX, Label::is_robot);
        let near_rest = masked.near(EDGE_PX, |label| !label.is_robot());
        for (at, label) in labelled.labels.iter().enumerate() {
            if *label == Label::Ignore || (near_robot[at] && near_rest[at]) {
                continue;
            }
            let counts = if near_robot[at] { &mut robot } else { &mut rest };
            counts[usize::from(label.is_robot() == near_robot[at])] += 1;
        }
    }
    // The rest of a room is easy: each of the two has to be right.
    for [wrong, right] in [robot, rest] {
        let share = right as f64 / (right + wrong) as f64;
        assert!(right > 10_000 && share >= 0.97, "{share} of {}", right + wrong);
    }
}

#[test]
fn an_lbr_before_a_zed_is_labelled_as_its_masks_have_it() {
    let Some(shared) = shared() else { return };
    assert_right(&Variant { masks: false, ..Variant::default() }.open(&shared));
}

#[test]
fn an_xarm_before_a_realsense_is_labelled_as_its_masks_have_it() {
    let Some(shared) = shared_with(XARM.folder) else { return };
    assert_right(&XARM.open(&shared, XARM.numbers, false));
}
