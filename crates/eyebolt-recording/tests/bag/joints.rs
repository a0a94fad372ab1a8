//! Joint states as publishers tell them.

use super::sample::{Bag, INFO_TOPIC, MS, START_NS, position};
use eyebolt_recording::FrameSource;

fn without_joints() -> Bag {
    Bag::default().with_depth().with_info(INFO_TOPIC)
}

#[test]
fn several_publishers_tell_their_own_joints() {
    let mut bag = without_joints();
    for i in 0..600 {
        let stamp = START_NS + 10 * MS * i;
        bag.joints(stamp, &[("shoulder", position(10 * MS * i)), ("elbow", 0.5)]);
        // Its stamps are behind those of the arm, though it tells them later.
        if i % 5 == 0 {
            let data = super::writer::joint_state(stamp - 30 * MS, &[("finger", 0.04)]);
            bag.add("/joint_states", "sensor_msgs/JointState", stamp + MS, data);
        }
    }
    // And once, as some drivers tell what never changes.
    bag.joints(START_NS + 77 * MS, &[("lift", 1.25)]);
    let bag = bag.open();
    let joints = bag.read_joints(0).unwrap();
    let told = ["shoulder", "elbow", "finger", "lift"].map(|name| joints.get(name).unwrap());
    assert_eq!(told, [0.0, 0.5, 0.04, 1.25]);
    assert_eq!(bag.problems("/joint_states"), Vec::<String>::new());
}

#[test]
fn names_in_another_order_every_time_are_the_same_joints() {
    let mut bag = without_joints();
    let ordered = without_joints().with_joints(&["shoulder", "elbow", "wrist", "hand"]);
    for i in 0..600 {
        let at = position(10 * MS * i);
        let mut joints = [("shoulder", at), ("elbow", -at), ("wrist", 0.1), ("hand", 0.2)];
        // All 24 orders, one after the other.
        joints.rotate_left((i % 4) as usize);
        joints[1..].rotate_left((i / 4 % 3) as usize);
        joints[2..].rotate_left((i / 12 % 2) as usize);
        bag.joints(START_NS + 10 * MS * i, &joints);
    }
    let (bag, ordered) = (bag.open(), ordered.open());
    assert_eq!(bag.frame_names(), ordered.frame_names());
    for index in 0..bag.frame_names().len() {
        assert_eq!(bag.read_joints(index).unwrap(), ordered.read_joints(index).unwrap());
    }
}

#[test]
fn a_joint_told_twice_is_taken_from_who_tells_most() {
    let mut bag = Bag::sample();
    // A program tells all joints when it starts, and never again.
    bag.joints(START_NS - MS, &[("finger", 0.1), ("shoulder", 3.0), ("elbow", 3.0)]);
    let bag = bag.open();
    let index = bag.frame_names().len() - 1;
    let joints = bag.read_joints(index).unwrap();
    let at = position(bag.stamp_ns(index).unwrap() - START_NS);
    assert!((joints.get("shoulder").unwrap() - at).abs() < 1e-9);
    assert!((joints.get("elbow").unwrap() + at).abs() < 1e-9);
    assert_eq!(joints.get("finger"), Some(0.1));
}

#[test]
fn stale_joints_are_not_used() {
    let mut bag = Bag::sample();
    let gap = |time: i64| (START_NS + 2100 * MS..START_NS + 4000 * MS).contains(&time);
    bag.messages.retain(|m| m.topic != "/joint_states" || !gap(m.log_time_ns));
    let bag = bag.open();
    let stale = |reason: &str| reason.starts_with("the nearest state of shoulder is");
    let stale: Vec<_> = bag.reasons().into_iter().filter(|(_, reason)| stale(reason)).collect();
    // From the first that is further than 25 ms from both ends of the gap.
    assert_eq!(stale.first().unwrap().0, 22);
    assert_eq!(stale.last().unwrap().0, 39);
    assert!(stale[5].1.contains(" s away"), "{stale:?}");
    // Told once, and long ago, is not enough for a whole arm.
    let mut once = without_joints();
    once.joints(START_NS, &[("shoulder", 0.5)]);
    assert_eq!(once.open().frame_names(), ["0"]);
}

#[test]
fn a_short_gap_is_crossed_where_nothing_moves() {
    let mut bag = Bag::sample();
    let gap = |time: i64| (START_NS + 100 * MS..START_NS + 1400 * MS).contains(&time);
    bag.messages.retain(|m| m.topic != "/joint_states" || !gap(m.log_time_ns));
    assert_eq!(bag.open().frame_names(), Bag::sample().open().frame_names());
}

#[test]
fn degrees_are_told_as_in_folders() {
    let mut bag = without_joints();
    for i in 0..600 {
        bag.joints(START_NS + 10 * MS * i, &[("shoulder", -90.0), ("elbow", 45.0), ("hand", 0.0)]);
    }
    bag.assert_says(&[
        "/joint_states",
        "the position of shoulder is -90, which looks like degrees",
        "Store radians",
    ]);
    // Wheels of the arm's base do turn so far.
    let mut mobile = Bag::sample();
    for i in 0..600 {
        mobile.joints(START_NS + 10 * MS * i, &[("wheel", 400.0)]);
    }
    assert_eq!(mobile.open().read_joints(0).unwrap().get("wheel"), Some(400.0));
}

#[test]
fn messages_without_positions_tell_nothing() {
    let mut bag = Bag::sample();
    for i in 0..50 {
        // As commands of effort look: names, and no positions.
        let cdr = super::writer::Cdr::with_header(START_NS + 10 * MS * i + 3 * MS, "");
        let data = cdr.count(1).text("shoulder").count(0).count(0).count(1).f64s(&[9.0]).done();
        bag.add("/joint_states", "sensor_msgs/JointState", START_NS + 10 * MS * i + 3 * MS, data);
    }
    assert_eq!(bag.open().frame_names(), Bag::sample().open().frame_names());
}

#[test]
fn joints_that_are_told_on_change_are_held() {
    let mut bag = Bag::sample();
    for (time, at) in [(0, 0.0), (2500, 0.04), (5900, 0.0)] {
        bag.joints(START_NS + time * MS, &[("finger", at)]);
    }
    let bag = bag.open();
    assert_eq!(bag.frame_names(), Bag::sample().open().frame_names());
    for index in 0..bag.frame_names().len() {
        let told = if bag.stamp_ns(index).unwrap() < START_NS + 2500 * MS { 0.0 } else { 0.04 };
        assert_eq!(bag.read_joints(index).unwrap().get("finger"), Some(told), "frame {index}");
    }
}

#[test]
fn the_joint_that_moves_is_named() {
    let mut bag = Bag::sample();
    for i in 0..600 {
        bag.joints(START_NS + 10 * MS * i, &[("axis", 0.01 * i as f64)]);
    }
    bag.assert_says(&["the arm moved: axis by", "mm if it slides"]);
}
