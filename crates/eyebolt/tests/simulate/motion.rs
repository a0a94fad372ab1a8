//! Frames taken while the arm moves, and clocks that differ.

use crate::stage::{Recorded, apart, small};
use eyebolt::simulate::Scenario;
use eyebolt_recording::DropReason;

fn scenario(moving_frames: usize, time_skew_s: f64) -> Scenario<'static> {
    let mut scenario = Scenario { configurations: 4, frames: 6, moving_frames, ..small() };
    scenario.faults.time_skew_s = time_skew_s;
    scenario
}

#[test]
fn frames_on_the_way_are_dropped_as_such() {
    let recorded = Recorded::of(scenario(9, 0.0));
    let dropped = recorded.recording.bag().unwrap().dropped_frames();
    assert_eq!((recorded.count(), dropped.len()), (4 * 6, 3 * 9));
    assert!(dropped.iter().all(|frame| matches!(frame.reason, DropReason::Moving { .. })));
}

/// Whatever the clocks: a frame takes part with the joints that the arm had, or not at all.
#[test]
fn clocks_that_differ_never_give_a_frame_the_joints_of_another() {
    for moving_frames in [0, 30] {
        let right = Recorded::of(scenario(moving_frames, 0.0));
        assert_eq!(right.count(), 24);
        let truth: Vec<_> =
            right.joints().into_iter().zip((0..24).map(|f| right.depth(f))).collect();
        for skew_s in [-0.6, -0.25, 0.04, 0.25, 0.6] {
            let skewed = Recorded::of(scenario(moving_frames, skew_s));
            for (frame, joints) in skewed.joints().iter().enumerate() {
                let depth = skewed.depth(frame);
                let (true_joints, _) = truth.iter().find(|(_, seen)| *seen == depth).unwrap();
                let apart = apart(joints, true_joints);
                assert!(apart < 0.005, "{moving_frames} {skew_s} {frame}: {apart}");
            }
        }
    }
}

/// With frames on the way, the motion tells how far the clocks are apart.
#[test]
fn the_motion_tells_how_far_the_clocks_are_apart() {
    for skew_s in [-0.25, 0.25] {
        let skewed = Recorded::of(scenario(50, skew_s));
        let offset = skewed.recording.bag().unwrap().clock_offset().unwrap();
        assert!(offset.seen && offset.applied, "{offset:?}");
        assert!((offset.seconds + skew_s).abs() <= offset.uncertainty_s.max(0.03), "{offset:?}");
        assert!(skewed.count() >= 4 * 3, "{}", skewed.count());
    }
}
