//! Programs that tell where joints would be, beside the driver that tells where they are.

use super::sample::{Bag, INFO_TOPIC, MS, START_NS, assert_arm_as_in_sample};
use eyebolt_recording::FrameSource;

const TOPIC: &str = "/joint_states";

/// The sample with joint states every 10 ms, and between them `other` every so many.
fn beside(every: i64, other: &[(&str, f64)]) -> Bag {
    let mut bag = Bag::sample();
    for i in (0..600).filter(|i| i % every == 0) {
        bag.joints(START_NS + 10 * MS * i + 5 * MS, other);
    }
    bag
}

#[test]
fn zeros_between_are_another_publishers() {
    for every in [1, 3, 50] {
        // The arm rests at zero at first, as many do.
        let bag = beside(every, &[("shoulder", 0.0), ("elbow", 0.0)]);
        assert_arm_as_in_sample(&bag, 1e-3);
        let problems = bag.open().problems(TOPIC);
        assert!(
            problems[0].starts_with("a second publisher tells the same joints"),
            "{problems:?}"
        );
    }
}

#[test]
fn so_are_the_middles_of_the_limits() {
    let bag = beside(10, &[("shoulder", 0.0), ("elbow", -1.57)]);
    assert_arm_as_in_sample(&bag, 1e-3);
}

#[test]
fn who_tells_more_joints_and_none_that_moves_is_not_believed() {
    // Ten times as often as the driver.
    let mut bag = Bag::sample();
    for i in 0..6000 {
        let zeros = [("elbow", 0.0), ("finger", 0.0), ("shoulder", 0.0)];
        bag.joints(START_NS + MS * i, &zeros);
    }
    assert_arm_as_in_sample(&bag, 1e-3);
    assert_eq!(bag.open().read_joints(0).unwrap().get("finger"), Some(0.0));
}

#[test]
fn an_arm_that_goes_home_again_and_again_is_no_second_publisher() {
    let mut bag = Bag::default().with_depth().with_info(INFO_TOPIC);
    for i in 0..600 {
        // Home for 300 ms, 100 ms away, 200 ms elsewhere, and 100 ms back.
        let phase = (10 * i % 700) as f64;
        let away = ((phase - 300.0) / 100.0).clamp(0.0, 1.0) - ((phase - 600.0) / 100.0).max(0.0);
        bag.joints(START_NS + 10 * MS * i, &[("shoulder", 0.5 * away)]);
    }
    let bag = bag.open();
    assert_eq!(bag.problems(TOPIC), Vec::<String>::new());
    let at = |index: usize| bag.read_joints(index).unwrap().get("shoulder").unwrap();
    let places = (0..bag.frame_names().len()).map(at);
    let (home, elsewhere) = (places.clone().filter(|p| *p < 1e-6), places.filter(|p| *p > 0.499));
    assert!(home.count() > 5 && elsewhere.count() > 5);
}
