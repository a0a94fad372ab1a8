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

/// Joints that are told for a frame are within this of those that the arm had: a slow beginning of a
/// motion counts as rest.
const NEARLY_RIGHT: f64 = 0.01;

/// For each frame that takes part how far the joints told are from those that the arm had, where the
/// frames of `right` tell them.
fn off(skewed: &Recorded, right: &Recorded) -> Vec<f64> {
    let known: Vec<_> =
        (0..right.count()).map(|frame| right.depth(frame)).zip(right.joints()).collect();
    let told = skewed.joints().into_iter().enumerate().map(|(frame, told)| {
        let depth = skewed.depth(frame);
        let (_, had) = known.iter().find(|(seen, _)| *seen == depth).expect("a frame at rest");
        apart(&told, had)
    });
    told.collect()
}

/// Without frames on the way nobody can tell that the clocks differ, but frames are not taken for
/// those of another configuration.
#[test]
fn a_difference_of_clocks_that_nobody_sees_costs_frames() {
    let right = Recorded::of(scenario(0, 0.0));
    for skew_s in [-0.25, 0.25, 0.4] {
        let skewed = Recorded::of(scenario(0, skew_s));
        let off = off(&skewed, &right);
        assert!(off.iter().all(|off| *off < NEARLY_RIGHT), "{skew_s}: {off:?}");
        // The arm rests for 0.3 s before and after what is seen of it.
        assert!(off.len() == 24 || skew_s.abs() > 0.3, "{skew_s}: {}", off.len());
    }
}
