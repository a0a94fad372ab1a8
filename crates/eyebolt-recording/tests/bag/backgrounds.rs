//! Depth of the scene without the robot, in bags of others and in damaged ones of ours.

use super::sample::{
    Bag, CLOUD, DEPTH_TOPIC, FRAME, IMAGE, INFO_TOPIC, MS, PIXELS, SIZE, START_NS, assert_says,
};
use super::writer;
use eyebolt_recording::{BagOptions, FrameSource, Recording, WriteRobot, write_folder, write_mcap};
use std::fs::File;

/// Sorted before the topic of the depth, so that whoever takes the first one takes this.
const TOPIC: &str = "/camera/background";

fn with_background(data: impl Fn(i64) -> Vec<u8>) -> Bag {
    let mut bag = Bag::sample();
    // Written down in the other order.
    for (stamp, log_time) in [(200, 300), (100, 400)] {
        bag.add(TOPIC, IMAGE, START_NS + log_time * MS, data(START_NS + stamp * MS));
    }
    bag
}

/// No whole millimetres.
const FIRST_M: f32 = 1.10025;
const SECOND_M: f32 = 1.20075;

fn sample() -> Bag {
    with_background(|stamp| {
        let depth = if stamp == START_NS + 100 * MS { FIRST_M } else { SECOND_M };
        writer::depth(stamp, FRAME, SIZE, &[depth; PIXELS])
    })
}

/// As in a bag that eyebolt wrote.
fn named(mut bag: Bag) -> Bag {
    bag.metadata.insert("background_topic".to_owned(), TOPIC.to_owned());
    bag
}

/// As where a flag says it.
fn flagged(mut bag: Bag) -> Bag {
    bag.options.background_topic = Some(TOPIC.to_owned());
    bag
}

#[test]
fn they_are_found_by_metadata_and_by_flag() {
    sample().assert_says(&["`depth_topic`", "several topics", TOPIC, DEPTH_TOPIC]);
    for bag in [named(sample()), flagged(sample())] {
        let bag = bag.open();
        assert_eq!(bag.frame_names(), Bag::sample().open().frame_names());
        assert_eq!(bag.role("depth").as_deref(), Some(DEPTH_TOPIC));
        assert_eq!(bag.role("background").as_deref(), Some(TOPIC));
        assert_eq!(bag.background_count(), 2);
        // In order of time.
        let first = |index| bag.read_background(index).unwrap().depth_m()[0];
        assert_eq!([first(0), first(1)], [FIRST_M, SECOND_M]);
        assert_says(bag.read_background(2), &["background index 2", "2 backgrounds"]);
    }
    assert_eq!(Bag::sample().open().background_count(), 0);
}

#[test]
fn a_flag_goes_before_the_metadata() {
    let mut bag = flagged(sample());
    bag.metadata.insert("background_topic".to_owned(), "/elsewhere".to_owned());
    assert_eq!(bag.open().background_count(), 2);
    // The depth of this recording is what once was a background.
    let mut bag = named(sample());
    bag.options.depth_topic = Some(TOPIC.to_owned());
    let bag = bag.open();
    // One of the two is stamped backward.
    assert_eq!((bag.background_count(), bag.frame_names().len()), (0, 1));
    assert_eq!(bag.role("depth").as_deref(), Some(TOPIC));
    let mut both = flagged(sample());
    both.options.depth_topic = Some(TOPIC.to_owned());
    both.assert_says(&["`background_topic`", TOPIC, "the depth too", "or only one of them"]);
}

#[test]
fn a_topic_that_is_named_must_be_there() {
    let bag = named(Bag::sample());
    bag.assert_says(&["metadata: background_topic", "there is no topic", TOPIC]);
    flagged(Bag::sample()).assert_says(&["`background_topic`", "there is no topic", TOPIC]);
    let mut bag = named(Bag::sample());
    bag.options.partial = true;
    assert_eq!(bag.open().background_count(), 0);
    // What a flag asks for is not left out.
    let mut bag = flagged(Bag::sample());
    bag.options.partial = true;
    bag.assert_says(&["`background_topic`", "there is no topic"]);
}

#[test]
fn only_depth_images_are_backgrounds() {
    let grey = |stamp| writer::image(stamp, FRAME, "mono8", SIZE, &[7; PIXELS]);
    named(with_background(grey)).assert_says(&["background_topic", TOPIC, "has no depth images"]);
    let mut bag = Bag::sample();
    bag.add(
        TOPIC,
        CLOUD,
        START_NS,
        writer::cloud(START_NS, FRAME, SIZE, &[[0.1, 0.0, 1.0]; PIXELS]),
    );
    let said = ["`background_topic`", "of type sensor_msgs/PointCloud2", "has no depth images"];
    flagged(bag).assert_says(&said);
}

#[test]
fn clouds_have_backgrounds_if_they_have_a_camera() {
    let mut bag = flagged(sample()).without(DEPTH_TOPIC);
    for i in 0..14 {
        let stamp = START_NS + 100 * MS * i + 5 * MS;
        let cloud = writer::cloud(stamp, FRAME, SIZE, &[[0.1, 0.0, 1.0]; PIXELS]);
        bag.add("/camera/depth/points", CLOUD, stamp, cloud);
    }
    let opened = bag.open();
    assert_eq!(opened.role("depth").as_deref(), Some("/camera/depth/points"));
    assert_eq!(opened.read_background(0).unwrap().depth_m()[0], FIRST_M);
    bag.without(INFO_TOPIC).assert_says(&[TOPIC, "no camera for it", "`camera_info`"]);
}

#[test]
fn they_are_of_the_camera_and_in_their_unit() {
    let small = |stamp| writer::depth(stamp, FRAME, (2, 2), &[1.0; 4]);
    let bag = named(with_background(small)).open();
    let said = [TOPIC, "at 1700000000.100 s", "the image is 2 x 2, but its camera info is 4 x 3"];
    assert_says(bag.read_background(0), &said);
    let float_mm = |stamp| writer::depth(stamp, FRAME, SIZE, &[1250.0; PIXELS]);
    let bag = named(with_background(float_mm)).open();
    assert_says(bag.read_background(0), &[TOPIC, "looks like millimetres", "REP 118"]);
    // The frames are in metres.
    let millimetres = [1250_u16; PIXELS].map(u16::to_le_bytes).concat();
    let integers = |stamp| writer::image(stamp, FRAME, "16UC1", SIZE, &millimetres);
    let bag = named(with_background(integers)).open();
    assert_eq!(bag.read_background(0).unwrap().depth_m(), [1.25; PIXELS]);
}

#[test]
fn damage_is_an_error_or_left_out() {
    let mut bag = named(sample());
    bag.on(TOPIC)[0].data.truncate(90);
    bag.assert_says(&[TOPIC, "data: takes 48 bytes", "`partial`"]);
    bag.options.partial = true;
    let bag = bag.open();
    assert_eq!(bag.background_count(), 1);
    assert_eq!(bag.read_background(0).unwrap().depth_m()[0], FIRST_M);
}

/// Of compressed images only the reading tells that they are damaged.
#[test]
fn damage_seen_late_is_left_out_too() {
    let mut bag = named(sample());
    for (index, message) in bag.on(TOPIC).into_iter().enumerate() {
        let mut rvl = vec![0; 12];
        rvl.extend([4, 0, 0, 0, 3, 0, 0, 0]);
        // A run of twelve zeros and none filled; or nothing at all.
        rvl.extend(if index == 0 { vec![] } else { 0xc1_00_00_00_u32.to_le_bytes().to_vec() });
        message.message_type = "sensor_msgs/CompressedImage";
        let format = "16UC1; compressedDepth rvl";
        message.data = writer::compressed(message.log_time_ns, FRAME, format, &rvl);
    }
    let strict = bag.open();
    let error = strict.read_background(0).unwrap_err();
    assert!(!strict.may_leave_out(&error), "{error}");
    bag.options.partial = true;
    let (folder, path) = bag.write();
    let recording = Recording::open(&path, &bag.options).unwrap();
    assert_eq!(recording.background_count(), 2);
    assert!(recording.may_leave_out(&recording.read_background(0).unwrap_err()));
    assert_eq!(recording.read_background(1).unwrap().depth_m(), [0.0; PIXELS]);
    let [files, copy] = ["files", "copy.mcap"].map(|name| folder.path().join(name));
    std::fs::create_dir(&files).unwrap();
    let (robot, go_on) = (WriteRobot::default(), &());
    write_folder(&recording, &robot, &files, go_on).unwrap();
    let written = Recording::open(&files, &BagOptions::default()).unwrap();
    assert_eq!(written.background_count(), 1);
    write_mcap(&recording, &robot, File::create(&copy).unwrap(), go_on).unwrap();
    assert_eq!(Recording::open(&copy, &bag.options).unwrap().background_count(), 2);
}

/// Each keeps the unit that it was stored in, and so all its bits.
#[test]
fn copies_hold_both_units() {
    let millimetres = [1250_u16; PIXELS].map(u16::to_le_bytes).concat();
    let integers = |stamp| writer::image(stamp, FRAME, "16UC1", SIZE, &millimetres);
    let mut floats = sample();
    for message in floats.on(DEPTH_TOPIC) {
        message.data = integers(message.log_time_ns);
    }
    for (bag, endings) in [(floats, ["png", "npy"]), (with_background(integers), ["npy", "png"])] {
        let (folder, path) = flagged(bag.clone()).write();
        let recording = Recording::open(&path, &flagged(bag).options).unwrap();
        let [copy, back] = ["copy.mcap", "back.mcap"].map(|name| folder.path().join(name));
        let files = folder.path().join("files");
        std::fs::create_dir(&files).unwrap();
        let robot = WriteRobot::default();
        let go_on = &();
        write_mcap(&recording, &robot, File::create(&copy).unwrap(), go_on).unwrap();
        write_folder(&recording, &robot, &files, go_on).unwrap();
        let [frame, background] = endings;
        assert!(files.join(format!("depth_0.{frame}")).is_file());
        assert!(files.join(format!("background_1.{background}")).is_file());
        let written = Recording::open(&files, &BagOptions::default()).unwrap();
        write_mcap(&written, &robot, File::create(&back).unwrap(), go_on).unwrap();
        for path in [&copy, &files, &back] {
            // The flag's word is part of the copy.
            let again = Recording::open(path, &BagOptions::default()).unwrap();
            assert_eq!(again.frame_names(), recording.frame_names());
            for index in 0..2 {
                let [a, b] = [&again, &recording].map(|r| r.read_background(index).unwrap());
                assert_eq!(a, b);
            }
        }
    }
}
