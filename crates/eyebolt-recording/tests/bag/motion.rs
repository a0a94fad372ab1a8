//! Frames are taken while the arm stands still.

use super::sample::{Bag, DEPTH_TOPIC, MS, START_NS, position};
use eyebolt_recording::{DropReason, FrameSource};
use proptest::prelude::*;

#[test]
fn frames_at_rest_are_kept_and_others_dropped_with_their_reason() {
    let bag = Bag::sample().open();
    // Every frame is taken for 50 ms on either side of its stamp.
    let moves = |i: i64| {
        let stamp = 100 * MS * i + 5 * MS;
        position(stamp + 50 * MS) - position(stamp - 50 * MS) > 0.0
    };
    let kept: Vec<_> = (0..60).filter(|i| !moves(*i)).map(|i| i.to_string()).collect();
    assert_eq!(bag.frame_names(), kept);
    for dropped in bag.dropped_frames() {
        assert!(moves(dropped.index as i64), "{dropped:?}");
        let DropReason::Moving { motion, limit, .. } = dropped.reason else {
            panic!("{dropped:?}")
        };
        assert!(motion > limit && limit == bag.motion_limit());
        assert!(dropped.reason.to_string().contains("the arm moved: shoulder by"));
    }
    assert_eq!(kept.len() + bag.dropped_frames().len(), 60);
    assert_eq!(bag.stamp_ns(0), Some(START_NS + 5 * MS));
    assert_eq!(bag.stamp_ns(kept.len()), None);
    assert!(bag.read_frame(kept.len()).unwrap_err().to_string().contains("does not exist"));
}

#[test]
fn the_limit_is_an_option() {
    let mut bag = Bag::sample();
    bag.options.max_motion = Some(1.0);
    assert_eq!(bag.open().frame_names().len(), 60);
    bag.options.max_motion = Some(0.03);
    let some = bag.open();
    assert_eq!(some.motion_limit(), 0.03);
    let least = Bag::sample().open().frame_names().len();
    assert!(some.frame_names().len() > least && some.frame_names().len() < 60);
}

#[test]
fn an_arm_that_never_rests_is_told() {
    let mut bag = Bag::default().with_depth().with_info(super::sample::INFO_TOPIC);
    for i in 0..600 {
        bag.joints(START_NS + 10 * MS * i, &[("shoulder", 0.005 * i as f64)]);
    }
    bag.assert_says(&[
        DEPTH_TOPIC,
        "none of its 60 frames can be used",
        "the arm moved",
        "`max_motion`",
    ]);
}

#[test]
fn joints_of_the_very_moment_need_no_others() {
    // One joint state for every frame, far from the next one in time and in place.
    let mut bag = Bag::default().with_info(super::sample::INFO_TOPIC);
    for i in 0..4 {
        let stamp = START_NS + 5000 * MS * i;
        let data =
            super::writer::depth(stamp, super::sample::FRAME, super::sample::SIZE, &[1.0; 12]);
        bag.add(DEPTH_TOPIC, super::sample::IMAGE, stamp, data);
        bag.joints(stamp, &[("shoulder", i as f64)]);
    }
    let bag = bag.open();
    assert_eq!(bag.reasons(), []);
    for i in 0..4 {
        assert_eq!(bag.read_joints(i).unwrap().get("shoulder"), Some(i as f64));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Between two joint states, the joints are where a straight line puts them.
    #[test]
    fn linear_motion_is_interpolated(
        (from, rise) in (-2.0..2.0_f64, -1e-2..1e-2_f64),
        share in 0.0..1.0_f64,
        step_ms in 2_i64..150,
    ) {
        let mut bag = Bag::default().with_info(super::sample::INFO_TOPIC);
        for i in 0..20 {
            bag.joints(START_NS + step_ms * MS * i, &[("shoulder", from + rise * i as f64)]);
        }
        let stamp = START_NS + (step_ms as f64 * MS as f64 * (9.0 + share)) as i64;
        let data = super::writer::depth(stamp, super::sample::FRAME, super::sample::SIZE, &[1.0; 12]);
        bag.add(DEPTH_TOPIC, super::sample::IMAGE, stamp, data);
        bag.options.max_motion = Some(10.0);
        let read = bag.open().read_joints(0).unwrap().get("shoulder").unwrap();
        prop_assert!((read - (from + rise * (9.0 + share))).abs() < 1e-6);
    }
}
