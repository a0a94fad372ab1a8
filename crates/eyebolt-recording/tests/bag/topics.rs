//! Which topics of a bag are the recording.

use super::sample::{
    Bag, CAMERA_INFO, CLOUD, DEPTH_TOPIC, FRAME, IMAGE, INFO_TOPIC, JOINT_STATE, MS, PIXELS, SIZE,
    START_NS, STRING,
};
use super::writer;
use eyebolt_recording::FrameSource;
use eyebolt_robot::Input;

fn one_depth(bag: &mut Bag, topic: &str) {
    let data = writer::depth(START_NS, FRAME, SIZE, &[1.0; PIXELS]);
    bag.add(topic, IMAGE, START_NS, data);
}

#[test]
fn the_only_ones_are_found_by_type() {
    let mut bag = Bag::sample();
    bag.add("/robot_description", STRING, START_NS, writer::text("<robot/>"));
    bag.add("/rosout", STRING, START_NS, writer::text("nothing"));
    bag.add(
        "/tf_static",
        "tf2_msgs/TFMessage",
        START_NS,
        writer::static_transform("base", "camera"),
    );
    bag.add("/diagnostics", "diagnostic_msgs/DiagnosticArray", START_NS, vec![1]);
    let bag = bag.open();
    assert_eq!(bag.role("depth").as_deref(), Some(DEPTH_TOPIC));
    assert_eq!(bag.role("intrinsics").as_deref(), Some(INFO_TOPIC));
    assert_eq!(bag.role("joints").as_deref(), Some("/joint_states"));
    assert_eq!(bag.role("robot").as_deref(), Some("/robot_description"));
    assert_eq!(bag.robot().description.as_deref(), Some("<robot/>"));
    assert_eq!(bag.camera_frame_id(), Some(FRAME));
    let transforms = bag.static_transforms();
    assert_eq!(transforms[0].child, "camera");
    assert_eq!(transforms[0].translation_m, [1.0, 2.0, 3.0]);
    let topics = bag.topics();
    assert!(topics.is_sorted_by_key(|topic| topic.name.clone()));
    assert!(topics.iter().all(|topic| topic.problems.is_empty()), "{topics:?}");
    let depth = topics.iter().find(|topic| topic.role == Some("depth")).unwrap();
    assert_eq!((depth.count, depth.message_type.as_str()), (60, IMAGE));
    assert!((depth.rate_hz.unwrap() - 10.0).abs() < 1e-9);
}

#[test]
fn of_several_one_must_be_named() {
    let mut bag = Bag::sample();
    one_depth(&mut bag, "/other/depth");
    bag.assert_says(&["`depth_topic`", "several topics have depth", DEPTH_TOPIC, "/other/depth"]);
    bag.options.depth_topic = Some(DEPTH_TOPIC.to_owned());
    assert_eq!(bag.open().role("depth").as_deref(), Some(DEPTH_TOPIC));
    bag.add("/gripper", JOINT_STATE, START_NS, writer::joint_state(START_NS, &[("finger", 0.1)]));
    bag.assert_says(&["`joint_topic`", "several topics", "/joint_states, /gripper"].map(
        |s| match s {
            "/joint_states, /gripper" => "/gripper, /joint_states",
            other => other,
        },
    ));
    bag.options.joint_topic = Some("/joint_states".to_owned());
    assert_eq!(bag.open().role("joints").as_deref(), Some("/joint_states"));
}

#[test]
fn a_wrong_name_is_told_with_the_right_ones() {
    let mut bag = Bag::sample();
    bag.options.depth_topic = Some("/depth".to_owned());
    bag.assert_says(&["`depth_topic`: there is no topic /depth", "Give one of", DEPTH_TOPIC]);
    bag.options.depth_topic = Some("/joint_states".to_owned());
    bag.assert_says(&["/joint_states is of type sensor_msgs/JointState and has no depth"]);
    bag.options.depth_topic = None;
    bag.options.joint_topic = Some(DEPTH_TOPIC.to_owned());
    bag.assert_says(&["`joint_topic`", "sensor_msgs/Image", "Give one of /joint_states"]);
    assert_eq!(bag.try_open().err().unwrap().input(), Some(Input::JOINT_TOPIC));
}

#[test]
fn what_is_missing_is_named() {
    let needed = |topic: &str| Bag::sample().without(topic);
    needed("/joint_states").assert_says(&["`joint_topic`: no topic has joint states", DEPTH_TOPIC]);
    needed(DEPTH_TOPIC)
        .assert_says(&["`depth_topic`: no topic has depth", "/joint_states (sensor"]);
    Bag::default().assert_says(&["no topic has depth", "no messages at all"]);
    let mut colour = needed(DEPTH_TOPIC);
    let rgb = writer::image(START_NS, FRAME, "rgb8", SIZE, &[7; 3 * PIXELS]);
    colour.add("/camera/color", IMAGE, START_NS, rgb);
    colour.assert_says(&["no topic has depth"]);
}

#[test]
fn images_are_better_than_what_is_made_of_them() {
    let mut bag = Bag::sample();
    let points = [[0.1, 0.1, 1.0]; PIXELS];
    bag.add("/camera/depth/points", CLOUD, START_NS, writer::cloud(START_NS, FRAME, SIZE, &points));
    // Infrared pictures are of the same kind as depth.
    let infrared = writer::image(START_NS, FRAME, "mono16", SIZE, &[7; 2 * PIXELS]);
    bag.add("/camera/infra", IMAGE, START_NS, infrared);
    assert_eq!(bag.open().role("depth").as_deref(), Some(DEPTH_TOPIC));
    bag.options.depth_topic = Some("/camera/depth/points".to_owned());
    // Its only frame lies before the first joints by less than they may.
    assert_eq!(bag.open().role("depth").as_deref(), Some("/camera/depth/points"));
}

#[test]
fn topics_in_other_languages_do_no_harm() {
    let mut bag = Bag::sample();
    bag.add("/odd", IMAGE, START_NS, vec![9; 40]);
    bag.add("/odd_info", CAMERA_INFO, START_NS, vec![9; 3]);
    let bag = bag.open();
    assert_eq!(bag.role("depth").as_deref(), Some(DEPTH_TOPIC));
    assert!(
        bag.problems("/odd")[0].contains("1 message cannot be read"),
        "{:?}",
        bag.problems("/odd")
    );
}

#[test]
fn both_parents_of_a_frame_are_told() {
    let mut bag = Bag::sample();
    for (time, parent) in [(0, "camera_link"), (1, "world"), (2, "camera_link")] {
        let data = writer::static_transform(parent, "camera_optical");
        bag.add("/robot1/tf_static", "tf2_msgs/TFMessage", START_NS + time, data);
    }
    // Another topic, whose name only ends in the same letters.
    let data = writer::static_transform("moving", "camera_optical");
    bag.add("/not_tf_static", "tf2_msgs/TFMessage", START_NS, data);
    let parents: Vec<_> = bag.open().static_transforms().into_iter().map(|t| t.parent).collect();
    assert_eq!(parents, ["camera_link", "world"]);
}

/// A description with these joints that turn.
fn describe(bag: &mut Bag, joints: &[&str]) {
    let links: String = (0..=joints.len()).map(|i| format!("<link name=\"l{i}\"/>")).collect();
    let turning = joints.iter().enumerate().map(|(i, name)| {
        format!(
            "<joint name=\"{name}\" type=\"continuous\"><parent link=\"l{i}\"/><child link=\"l{}\"/></joint>",
            i + 1
        )
    });
    let urdf = format!("<robot name=\"arm\">{links}{}</robot>", turning.collect::<String>());
    bag.add("/robot_description", STRING, START_NS, writer::text(&urdf));
}

#[test]
fn of_several_topics_of_joints_the_one_with_the_robots_own_is_taken() {
    let mut bag = Bag::sample();
    for i in 0..600 {
        let stamp = START_NS + 10 * MS * i;
        let told = |name: &str| writer::joint_state(stamp, &[(name, 0.1)]);
        bag.add("/gripper", JOINT_STATE, stamp, told("finger"));
        bag.add("/left/joint_states", JOINT_STATE, stamp, told("l_shoulder"));
    }
    let undescribed = bag.clone();
    describe(&mut bag, &["shoulder", "elbow", "finger"]);
    assert_eq!(bag.open().role("joints").as_deref(), Some("/joint_states"));
    // The robot that the caller names is the one that counts.
    let with = |joints: &[&str], bag: &Bag| {
        let mut bag = bag.clone();
        bag.options.robot_joints = joints.iter().map(|name| (*name).to_owned()).collect();
        bag
    };
    let joints_of = |bag: Bag| bag.open().role("joints");
    assert_eq!(joints_of(with(&["elbow"], &undescribed)).as_deref(), Some("/joint_states"));
    assert_eq!(joints_of(with(&["l_shoulder"], &bag)).as_deref(), Some("/left/joint_states"));
    // Where two tell as many, or none tells any, a person decides.
    let several = ["`joint_topic`", "several topics", "/gripper, /joint_states"];
    undescribed.assert_says(&several);
    with(&["stranger"], &bag).assert_says(&several);
    for message in bag.clone().on("/joint_states") {
        bag.add("/joint_states_desired", JOINT_STATE, message.log_time_ns, message.data.clone());
    }
    bag.assert_says(&["`joint_topic`", "several topics", "/joint_states, /joint_states_desired"]);
}
