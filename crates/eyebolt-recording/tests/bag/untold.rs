//! Joint states that do not tell all that they name: only what is not told is lost.

use super::sample::{
    Bag, INFO_TOPIC, JOINT_STATE, MS, START_NS, assert_arm_as_in_sample, position,
};
use super::writer::{Cdr, joint_state};
use eyebolt_recording::{BagOptions, Folder, FrameSource, Recording, WriteRobot, write_folder};

const TOPIC: &str = "/joint_states";

/// The sample, whose joint states also name `lift`, as `tell` says.
fn with_lift(tell: impl Fn(i64) -> Vec<(&'static str, f64)>) -> Bag {
    let mut bag = Bag::default().with_depth().with_info(INFO_TOPIC);
    for i in 0..600 {
        let at = position(10 * MS * i);
        let joints = [vec![("shoulder", at), ("elbow", -at)], tell(i)].concat();
        bag.joints(START_NS + 10 * MS * i, &joints);
    }
    bag
}

#[test]
fn what_is_no_position_of_one_joint_costs_the_others_nothing() {
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        // Always, sometimes, and once.
        for every in [1, 7, 600] {
            let bag = with_lift(|i| vec![("lift", if i % every == 0 { bad } else { 0.3 })]);
            assert_arm_as_in_sample(&bag, 1e-9);
            let bag = bag.open();
            let count = (600 + every - 1) / every;
            let often = if every == 1 { "all".to_owned() } else { format!("{count} of") };
            let said = format!("the position of lift is {bad} in {often} 600 messages: it counts");
            assert!(bag.problems(TOPIC)[0].starts_with(&said), "{:?}", bag.problems(TOPIC));
            let told = bag.read_joints(1).unwrap().get("lift");
            // Between others that tell it, it is where these say.
            assert_eq!(told, (every != 1).then_some(0.3));
            assert!(bag.provenance().untold_joints["lift"].starts_with("the position of lift"));
        }
    }
}

#[test]
fn a_joint_that_is_not_told_for_a_while_is_not_there_meanwhile() {
    let bag = with_lift(|i| vec![("lift", if (100..400).contains(&i) { f64::NAN } else { 0.3 })]);
    assert_arm_as_in_sample(&bag, 1e-9);
    let bag = bag.open();
    for index in 0..bag.frame_names().len() {
        let at_ms = (bag.stamp_ns(index).unwrap() - START_NS) / MS;
        let told = bag.read_joints(index).unwrap().get("lift");
        assert_eq!(told.is_none(), (990..4000).contains(&at_ms), "at {at_ms} ms: {told:?}");
    }
}

#[test]
fn a_name_that_stands_there_twice_costs_the_others_nothing() {
    assert_arm_as_in_sample(&with_lift(|_| vec![("lift", 0.3), ("lift", 0.3)]), 1e-9);
    let once = with_lift(|_| vec![("lift", 0.3), ("lift", 0.3)]).open();
    assert_eq!(once.read_joints(0).unwrap().get("lift"), Some(0.3));
    assert_eq!(once.problems(TOPIC), Vec::<String>::new());
    let twice = with_lift(|_| vec![("lift", 0.3), ("lift", 0.4)]);
    assert_arm_as_in_sample(&twice, 1e-9);
    let twice = twice.open();
    assert_eq!(twice.read_joints(0).unwrap().get("lift"), None);
    let said = "lift stands there twice, at different positions, in all 600 messages";
    assert!(twice.problems(TOPIC)[0].starts_with(said), "{:?}", twice.problems(TOPIC));
}

#[test]
fn a_short_list_of_positions_is_that_of_the_first_names() {
    let mut bag = Bag::default().with_depth().with_info(INFO_TOPIC);
    for i in 0..600 {
        let (stamp, at) = (START_NS + 10 * MS * i, position(10 * MS * i));
        let names =
            Cdr::with_header(stamp, "").count(3).text("shoulder").text("elbow").text("lift");
        let data = names.count(2).f64s(&[at, -at]).count(0).count(0).done();
        bag.add(TOPIC, JOINT_STATE, stamp, data);
    }
    assert_arm_as_in_sample(&bag, 1e-9);
    let said = "the list of positions ends before lift in all 600 messages";
    assert!(bag.open().problems(TOPIC)[0].starts_with(said));
}

#[test]
fn a_folder_has_the_frames_that_tell_what_most_frames_tell() {
    // `lift` is told in the second half alone, and `spare` hardly ever.
    let bag = with_lift(|i| {
        let spare = if i < 3 { 0.1 } else { f64::NAN };
        vec![("lift", if i < 150 { f64::NAN } else { 0.3 }), ("spare", spare)]
    });
    let (folder, path) = bag.write();
    let recording = Recording::open(&path, &BagOptions::default()).unwrap();
    let files = folder.path().join("files");
    std::fs::create_dir(&files).unwrap();
    write_folder(&recording, &WriteRobot::default(), &files, &()).unwrap();
    let written = Folder::open(&files).unwrap();
    let known = recording.frame_names().len();
    assert!(written.frame_names().len() < known && 2 * written.frame_names().len() > known);
    let joints = written.read_joints(0).unwrap();
    assert_eq!((joints.get("lift"), joints.get("spare")), (Some(0.3), None));
}

#[test]
fn a_topic_whose_joints_are_never_told_is_named_with_the_reason() {
    let mut bag = Bag::default().with_depth().with_info(INFO_TOPIC);
    let unusable = |stamp| joint_state(stamp, &[("shoulder", f64::NAN)]);
    for i in 0..600 {
        bag.add(TOPIC, JOINT_STATE, START_NS + 10 * MS * i, unusable(START_NS + 10 * MS * i));
    }
    bag.assert_says(&[
        "`joint_topic`: no topic has joint states (sensor_msgs/JointState) that can be used",
        "/joint_states: the position of shoulder is NaN in all 600 messages",
    ]);
}
