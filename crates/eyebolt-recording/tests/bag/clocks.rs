//! Time stamps that lie.

use super::sample::{
    Bag, DEPTH_TOPIC, FRAME, IMAGE, INFO_TOPIC, MS, Opened, PIXELS, SIZE, START_NS, position,
};
use super::writer;
use eyebolt_recording::FrameSource;

const JOINTS: &str = "/joint_states";

#[test]
fn stamps_that_nobody_set_are_replaced_and_told() {
    let mut bag = Bag::sample();
    bag.restamp(DEPTH_TOPIC, |_, _| 0);
    let read = bag.open();
    assert_careful(&read);
    assert_eq!(
        read.problems(DEPTH_TOPIC),
        ["60 messages have no time stamp; the time of recording stands in"]
    );
    assert_eq!(read.clock_offset(), None);
    bag.restamp(JOINTS, |_, _| 0);
    assert_careful(&bag.open());
}

/// How long transport takes is not known, so frames within 150 ms of motion are left out; depth is
/// taken for 50 ms on either side, ten times a second.
#[track_caller]
fn assert_careful(read: &Opened) {
    let sure = Bag::sample().open();
    let number = |name: &String| name.parse::<i64>().unwrap();
    let moving = |i: i64| position(100 * MS * i + 205 * MS) > position(100 * MS * i - 195 * MS);
    let expected: Vec<_> = sure.frame_names().iter().filter(|name| !moving(number(name))).collect();
    assert_eq!(read.frame_names().iter().collect::<Vec<_>>(), expected);
    assert!(expected.len() < sure.frame_names().len());
}

#[test]
fn a_few_stamps_that_run_backward_are_dropped() {
    let mut bag = Bag::sample();
    bag.restamp(DEPTH_TOPIC, |index, stamp| if index == 7 { stamp - 150 * MS } else { stamp });
    bag.restamp(JOINTS, |index, stamp| if index % 150 == 9 { stamp - 25 * MS } else { stamp });
    let bag = bag.open();
    let (index, reason) = bag.reasons().remove(0);
    assert_eq!((index, reason.as_str()), (7, "its time stamp is not later than the one before"));
    assert_eq!(bag.problems(DEPTH_TOPIC), ["1 time stamp runs backward"]);
    assert_eq!(bag.problems(JOINTS), ["4 time stamps run backward"]);
    let kept = Bag::sample().open();
    assert_eq!(bag.frame_names().len(), kept.frame_names().len() - 1);
    assert_eq!(bag.depth_m(7), kept.depth_m(8));
}

#[test]
fn many_are_an_error() {
    for topic in [DEPTH_TOPIC, JOINTS] {
        let mut bag = Bag::sample();
        bag.restamp(topic, |index, stamp| if index % 10 == 5 { stamp - 250 * MS } else { stamp });
        bag.assert_says(&[
            topic,
            "stamps run backward, first from 1700000000.",
            "Two programs publish there",
        ]);
    }
    // As in an endless loop of the same recording.
    let mut bag = Bag::sample();
    bag.restamp(JOINTS, |index, stamp| if index >= 300 { stamp - 3000 * MS } else { stamp });
    bag.assert_says(&[JOINTS, "stamps run backward"]);
}

#[test]
fn stamps_told_again_do_no_harm() {
    let mut bag = Bag::sample();
    for message in bag.clone().messages.into_iter().filter(|m| m.topic == JOINTS) {
        bag.messages.push(message);
    }
    let bag = bag.open();
    assert_eq!(bag.problems(JOINTS), Vec::<String>::new());
    assert_eq!(bag.frame_names(), Bag::sample().open().frame_names());
}

#[test]
fn clocks_of_their_own_are_shifted_and_told() {
    let mut bag = Bag::sample();
    // As cameras do that count from when they were switched on.
    bag.restamp(DEPTH_TOPIC, |_, stamp| stamp - START_NS + 1000 * MS);
    let read = bag.open();
    let offset = read.clock_offset().unwrap();
    assert!(offset.applied && (offset.seconds - 1_699_999_999.0).abs() < 1e-3, "{offset:?}");
    assert_careful(&read);
    assert_eq!(read.stamp_ns(0), Some(1005 * MS));
    // The other way round.
    let mut bag = Bag::sample();
    bag.restamp(JOINTS, |_, stamp| stamp - START_NS + 1000 * MS);
    let read = bag.open();
    assert!(read.clock_offset().unwrap().applied);
    assert_careful(&read);
}

#[test]
fn a_delay_of_the_depth_is_told_and_makes_it_careful() {
    let mut bag = Bag::sample();
    for message in bag.on(DEPTH_TOPIC) {
        message.log_time_ns += 80 * MS;
    }
    let read = bag.open();
    let offset = read.clock_offset().unwrap();
    assert!(!offset.applied && (offset.seconds - 0.08).abs() < 1e-6, "{offset:?}");
    assert!((offset.uncertainty_s - 0.08).abs() < 1e-6);
    // Frames so near to motion that they may be of it are not used.
    let sure = Bag::sample().open();
    assert!(read.frame_names().len() < sure.frame_names().len());
    assert!(read.frame_names().iter().all(|name| sure.frame_names().contains(name)));
}

#[test]
fn frames_that_come_out_of_order_are_dropped() {
    let mut bag = Bag::sample();
    // The tenth comes when the twelfth has been there.
    bag.on(DEPTH_TOPIC)[10].log_time_ns += 250 * MS;
    let bag = bag.open();
    let reason = "its time stamp is not later than the one before";
    // It is the one behind two others now.
    assert!(bag.reasons().contains(&(12, reason.to_owned())), "{:?}", bag.reasons());
}

#[test]
fn the_longest_times_do_not_overflow() {
    let far = i64::from(i32::MAX) * 1_000_000_000;
    for (depth, joints) in [(-far, far), (far, -far), (-far, -far)] {
        let mut bag = Bag::sample();
        // Enough of them that motion is looked for.
        for message in bag.clone().messages.into_iter().filter(|m| m.topic == DEPTH_TOPIC) {
            bag.messages.push(message);
        }
        bag.restamp(DEPTH_TOPIC, |index, _| depth + index as i64);
        bag.restamp(JOINTS, |index, _| joints + index as i64);
        // Read or refused, but not broken.
        let _ = bag.try_open();
        bag.restamp(JOINTS, |index, _| if index % 200 == 0 { 0 } else { joints + index as i64 });
        let _ = bag.try_open();
        bag.messages
            .iter_mut()
            .for_each(|m| m.log_time_ns = i64::MAX - (m.log_time_ns - START_NS) % 9);
        let _ = bag.try_open();
    }
    assert!(Bag::sample().without(INFO_TOPIC).try_open().is_err());
}

#[test]
fn one_stamp_that_nobody_set_costs_one_frame_at_most() {
    let mut bag = Bag::sample();
    // A camera with a clock of its own, whose first image came before it knew the time.
    let own = |stamp: i64| stamp - START_NS + 1000 * MS;
    bag.restamp(DEPTH_TOPIC, |index, stamp| if index == 0 { 0 } else { own(stamp) });
    assert_careful(&bag.open());
}

#[test]
fn frames_that_are_late_by_another_clock_are_not_of_motion() {
    let mut bag = Bag::sample();
    bag.restamp(DEPTH_TOPIC, |_, stamp| stamp - START_NS + 1000 * MS);
    for message in bag.on(DEPTH_TOPIC) {
        message.log_time_ns += 120 * MS;
    }
    let read = bag.open();
    for index in 0..read.frame_names().len() {
        let taken = read.stamp_ns(index).unwrap() - 1000 * MS;
        assert_eq!(position(taken), position(taken + 50 * MS), "frame {index}");
        let joints = read.read_joints(index).unwrap();
        assert!((joints.get("shoulder").unwrap() - position(taken)).abs() < 1e-9, "frame {index}");
    }
}

#[test]
fn motion_in_the_pixels_tells_a_small_offset() {
    let offset_ms = 230;
    let mut bag = Bag::default().with_joints(&["shoulder", "elbow"]).with_info(INFO_TOPIC);
    for i in 0..180 {
        let taken = 33 * MS * i;
        // All pixels change when the arm moves, as they hardly do in life.
        let depth = [(1.0 + 4.0 * position(taken)) as f32; PIXELS];
        let stamp = START_NS + taken - offset_ms * MS;
        let data = writer::depth(stamp, FRAME, SIZE, &depth);
        bag.add(DEPTH_TOPIC, IMAGE, START_NS + taken + 20 * MS, data);
    }
    let read = bag.open();
    let offset = read.clock_offset().unwrap();
    assert!(offset.seen && offset.applied, "{offset:?}");
    assert!((offset.seconds - 1e-3 * offset_ms as f64).abs() < 0.025, "{offset:?}");
    // Joints are those of the moment, not of the stamp, and no frame of motion is left.
    for index in 0..read.frame_names().len() {
        let taken = read.stamp_ns(index).unwrap() - START_NS + offset_ms * MS;
        let joints = read.read_joints(index).unwrap();
        assert!((joints.get("shoulder").unwrap() - position(taken)).abs() < 1e-3, "frame {index}");
    }
    assert!(read.frame_names().len() > 60);
}
