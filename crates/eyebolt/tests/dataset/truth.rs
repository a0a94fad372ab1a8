//! Labels against what an ideal camera sees.

use crate::made::{Calibration, KINECT, scenario};
use eyebolt::dataset::{LeftOut, code};
use eyebolt::simulate::TrueView;
use eyebolt_recording::{Frame, FrameSource, InMemory, Range};
use eyebolt_registration::Label;
use eyebolt_render::Sensor;

/// How many pixels with depth there are, how many are ignored, and how many labelled right.
#[derive(Default)]
struct Counts {
    all: usize,
    ignored: usize,
    right: usize,
}

fn counted(made: &Calibration) -> Counts {
    let (run, mut counts) = (made.run(&made.source), Counts::default());
    for index in 0..made.source.frame_names().len() {
        let labelled = run.frame(index).unwrap().unwrap().frame;
        let TrueView { label: truth, .. } = made.plan.true_view(index);
        for (at, label) in labelled.labels.iter().enumerate() {
            if labelled.depth.depth_m()[at] <= 0.0 {
                assert_eq!(*label, Label::Ignore);
                continue;
            }
            counts.all += 1;
            counts.ignored += usize::from(*label == Label::Ignore);
            counts.right += usize::from(code(*label) == truth[at]);
        }
        let seen = labelled.keypoints.iter().zip(&labelled.labels).filter(|(class, _)| **class > 0);
        assert!(seen.clone().all(|(_, label)| *label == Label::EndEffector));
    }
    counts
}

#[track_caller]
fn assert_right(made: &Calibration, name: &str) {
    let Counts { all, ignored, right } = counted(made);
    let (ignored_share, right_share) =
        (ignored as f64 / all as f64, right as f64 / (all - ignored) as f64);
    assert!(ignored_share <= 0.03, "{name}: {ignored_share} ignored");
    assert!(right_share >= 0.995, "{name}: {right_share} right");
}

#[test]
fn every_camera_some_with_frames_of_the_background() {
    for (number, sensor) in Sensor::ALL.into_iter().enumerate() {
        let backgrounds = 2 * (number % 2);
        assert_right(&Calibration::of(scenario(sensor, backgrounds)), sensor.name);
    }
}

#[test]
fn the_end_effector_is_where_it_is_labelled() {
    let run = KINECT.run(&KINECT.source);
    for index in 0..KINECT.source.frame_names().len() {
        let labelled = run.frame(index).unwrap().unwrap();
        let pose = labelled.frame.camera_from_end_effector;
        let arm = &crate::stage::ARM;
        let truth =
            KINECT.plan.camera_from_base() * arm.base_from_end_effector(&labelled.joints).unwrap();
        let (metres, radians) = pose.distance_to(&truth);
        assert!(metres < 0.003 && radians < 0.005, "{metres} {radians}");
        // The keypoints are those of the end-effector, in the same place.
        let hand = crate::made::HAND.keypoints(&labelled.joints);
        for (seen, own) in labelled.frame.keypoints_in_camera.iter().zip(&hand) {
            assert!((seen - pose.point(own)).norm() < 1e-12);
        }
    }
}

/// Frames that carry each other's joints show the arm elsewhere.
#[test]
fn frames_with_the_joints_of_others_are_left_out() {
    let source = &KINECT.source;
    let mut exchanged = InMemory::new(source.camera().unwrap().clone());
    let count = source.frame_names().len();
    for index in 0..count {
        let Frame { name, range: Range::Depth(depth), .. } = source.read_frame(index).unwrap()
        else {
            panic!("depth images")
        };
        let joints = source.read_joints((index + 1) % count).unwrap();
        exchanged.push(name, depth, joints).unwrap();
    }
    let run = KINECT.run(&exchanged);
    for index in 0..count {
        let left_out = run.frame(index).unwrap().unwrap_err();
        assert!(matches!(left_out, LeftOut::Contradicts(_)), "{left_out}");
        assert!(left_out.to_string().contains("% of the arm's pixels"), "{left_out}");
    }
}
