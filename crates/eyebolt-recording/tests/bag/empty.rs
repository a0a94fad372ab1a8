//! Frames in which the camera saw nothing.

use super::sample::{Bag, CLOUD, DEPTH_TOPIC, FRAME, INFO_TOPIC, MS, SIZE, START_NS, assert_says};
use super::writer;
use super::writer::Message;
use eyebolt_recording::{
    BagOptions, FrameSource, Recording, RecordingError, WriteError, WriteRobot, write_folder,
};

/// Makes it a compressed image, of which only the reading tells that it has no depth.
fn without_depth(message: &mut Message) {
    // Twelve bytes of configuration, the size, and a run of twelve zeros and none filled.
    let mut rvl = vec![0; 12];
    rvl.extend([4, 0, 0, 0, 3, 0, 0, 0]);
    rvl.extend(0xc1_00_00_00_u32.to_le_bytes());
    message.message_type = "sensor_msgs/CompressedImage";
    let format = "16UC1; compressedDepth rvl";
    message.data = writer::compressed(message.log_time_ns, FRAME, format, &rvl);
}

#[test]
fn images_without_depth_are_dropped() {
    let empty = [
        writer::depth(START_NS + 205 * MS, FRAME, SIZE, &[f32::NAN; 12]),
        writer::depth(START_NS + 205 * MS, FRAME, SIZE, &[0.0; 12]),
        writer::depth(START_NS + 205 * MS, FRAME, SIZE, &[f32::INFINITY; 12]),
    ];
    for data in empty {
        let mut bag = Bag::sample();
        bag.on(DEPTH_TOPIC)[2].data = data;
        let bag = bag.open();
        assert_eq!(bag.reasons()[0], (2, "no pixel has depth".to_owned()));
        assert_eq!(bag.frame_names()[2], "3");
    }
}

#[test]
fn clouds_without_points_are_dropped() {
    let mut bag = Bag::sample().without(DEPTH_TOPIC).without(INFO_TOPIC);
    for i in 0..5 {
        let stamp = START_NS + 100 * MS * i + 5 * MS;
        // The first tells nothing of the frame of the points either.
        let point = if i == 0 { [f32::NAN; 3] } else { [0.1, 0.1, 1.0] };
        bag.add("/points", CLOUD, stamp, writer::cloud(stamp, FRAME, SIZE, &[point; 12]));
    }
    let bag = bag.open();
    assert_eq!(bag.reasons(), [(0, "no pixel has depth".to_owned())]);
    assert_eq!(bag.frame_names(), ["1", "2", "3", "4"]);
}

#[test]
fn compressed_images_without_depth_are_an_error() {
    let mut bag = Bag::sample();
    for message in bag.on(DEPTH_TOPIC) {
        without_depth(message);
    }
    assert_says(bag.open().read_frame(0), &[DEPTH_TOPIC, "1700000000.005 s", "no pixel has depth"]);
}

#[test]
fn nothing_but_empty_frames_is_an_error() {
    let mut bag = Bag::sample();
    for message in bag.on(DEPTH_TOPIC) {
        message.data = writer::depth(message.log_time_ns, FRAME, SIZE, &[0.0; 12]);
    }
    bag.assert_says(&["none of its 60 frames can be used; of the first, no pixel has depth"]);
}

#[test]
fn compressed_images_without_depth_may_be_left_out() {
    let mut bag = Bag::sample();
    for message in bag.on(DEPTH_TOPIC) {
        message.data = writer::depth(message.log_time_ns, FRAME, SIZE, &[1.0; 12]);
    }
    let bag = bag.open();
    let empty = RecordingError::EmptyFrame { path: "bag".into(), field: "frame".to_owned() };
    assert!(bag.may_leave_out(&empty));
    // A frame that is not there, or damage that was not said to be no matter, may not.
    assert!(!bag.may_leave_out(&bag.read_frame(1000).unwrap_err()));
}

#[test]
fn a_folder_of_no_frame_is_not_written() {
    let mut bag = Bag::sample();
    for message in bag.on(DEPTH_TOPIC) {
        without_depth(message);
    }
    // Names of masks and pictures must not be left behind either.
    let (_folder, path) = bag.write();
    let recording = Recording::open(&path, &BagOptions::default()).unwrap();
    let frames = recording.frame_names().len();
    let output = tempfile::tempdir().unwrap();
    let go_on = &();
    let written = write_folder(&recording, &WriteRobot::default(), output.path(), go_on);
    let Err(WriteError::NoFrameLeft { count, .. }) = &written else { panic!("{written:?}") };
    assert_eq!(*count, frames);
    let said =
        format!("bag.mcap: frames: all {frames} were left out: no pixel has depth ({frames})");
    let text = written.unwrap_err().to_string();
    assert!(text.contains(&said), "{text}");
    assert_eq!(std::fs::read_dir(output.path()).unwrap().count(), 0);
}
