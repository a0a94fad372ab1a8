//! One topic of several: what is recommended, and what is said of those that do not fit.

use super::sample::{Bag, DEPTH_TOPIC, FRAME, IMAGE, INFO_TOPIC, PIXELS, SIZE, START_NS};
use super::writer;
use eyebolt_recording::{DepthChoice, FrameSource};

const ALIGNED: &str = "/camera/aligned_depth_to_color/image_raw";

fn with_depth_on(topic: &str) -> Bag {
    let mut bag = Bag::sample();
    for message in bag.clone().on(DEPTH_TOPIC) {
        bag.add(topic, IMAGE, message.log_time_ns, message.data.clone());
    }
    bag
}

#[test]
fn the_raw_depth_is_recommended_and_taken_where_that_is_allowed() {
    let mut bag = with_depth_on(ALIGNED);
    bag.assert_says(&[
        &format!(
            "several topics have depth (Image in 16UC1 or 32FC1, compressedDepth, or \
                  PointCloud2): {ALIGNED}, {DEPTH_TOPIC}"
        ),
        &format!("Give {DEPTH_TOPIC}: the others were made of what it has"),
    ]);
    bag.options.any_depth = true;
    let opened = bag.open();
    assert_eq!(opened.role("depth").as_deref(), Some(DEPTH_TOPIC));
    assert_eq!(opened.provenance().depth_choice, Some(DepthChoice::Raw));
    // Of two cameras, neither is made of the other.
    let mut two = with_depth_on("/other/depth/image_raw");
    two.assert_says(&["Give one of them"]);
    two.options.any_depth = true;
    assert_eq!(two.open().provenance().depth_choice, Some(DepthChoice::First));
    assert_eq!(Bag::sample().open().provenance().depth_choice, None);
}

#[test]
fn a_background_that_is_named_must_be_of_the_size_of_the_depth() {
    let mut bag = Bag::sample();
    let data = writer::depth(START_NS, FRAME, (2, 1), &[1.0; 2]);
    bag.add("/empty_scene", IMAGE, START_NS, data);
    bag.options.background_topic = Some("/empty_scene".to_owned());
    bag.assert_says(&["`background_topic`: /empty_scene is 2 x 1, the depth 4 x 3"]);
}

#[test]
fn only_topics_of_the_type_asked_for_are_listed() {
    let mut bag = Bag::sample().without(DEPTH_TOPIC);
    let data = writer::image(START_NS, FRAME, "rgb8", SIZE, &[7; 3 * PIXELS]);
    bag.add("/camera/color", IMAGE, START_NS, data);
    let error = bag.try_open().err().unwrap().to_string();
    assert!(error.contains("/camera/color: 4 x 3 in rgb8"), "{error}");
    assert!(!error.contains("/joint_states") && !error.contains(INFO_TOPIC), "{error}");
}

#[test]
fn an_empty_bag_is_called_so() {
    Bag::default().assert_says(&["the bag: it is empty", "ROS_DOMAIN_ID"]);
}
