//! Where the intrinsics come from.

use super::sample::{Bag, CAMERA_INFO, DEPTH_TOPIC, FRAME, IMAGE, INFO_TOPIC, MS, SIZE, START_NS};
use super::writer;
use eyebolt_recording::FrameSource;

fn info(bag: &mut Bag, topic: &str, frame: &str, size: (u32, u32), focal: f64) {
    let count = bag.on(topic).len() as i64;
    let time = START_NS + count * MS;
    bag.add(topic, CAMERA_INFO, time, writer::camera_info(time, frame, size, focal));
}

fn without_info() -> Bag {
    Bag::sample().without(INFO_TOPIC)
}

fn focal(bag: &Bag) -> f64 {
    bag.open().camera().unwrap().fx()
}

#[test]
fn beside_the_picture_is_best() {
    let mut bag = Bag::sample();
    info(&mut bag, "/other/camera_info", FRAME, SIZE, 9.0);
    assert_eq!(focal(&bag), 5.0);
    bag.options.camera_info_topic = Some("/other/camera_info".to_owned());
    assert_eq!(focal(&bag), 9.0);
    bag.options.camera_info_topic = Some("/joint_states".to_owned());
    bag.assert_says(&["`camera_info_topic`", INFO_TOPIC, "/other/camera_info"]);
}

#[test]
fn elsewhere_the_size_and_the_frame_must_agree() {
    let mut bag = without_info();
    info(&mut bag, "/a/camera_info", FRAME, (8, 6), 7.0);
    info(&mut bag, "/b/camera_info", "other", SIZE, 8.0);
    bag.assert_says(&[
        "`camera_info_topic`",
        &format!("the intrinsics of {DEPTH_TOPIC}"),
        "/a/camera_info",
        "`camera_info`",
    ]);
    info(&mut bag, "/c/camera_info", FRAME, SIZE, 9.0);
    assert_eq!(focal(&bag), 9.0);
    info(&mut bag, "/d/camera_info", FRAME, SIZE, 9.5);
    bag.assert_says(&["several topics have the intrinsics", "/c/camera_info, /d/camera_info"]);
}

#[test]
fn rectified_pictures_have_the_intrinsics_of_the_projection() {
    let mut bag = without_info();
    for message in bag.on(DEPTH_TOPIC) {
        message.topic = "/camera/depth/image_rect_raw".to_owned();
    }
    info(&mut bag, INFO_TOPIC, FRAME, SIZE, 8.0);
    assert_eq!(focal(&bag), 4.0);
    // A word of the picture's own name tells, not part of one, and not where it lies.
    for name in ["/director/depth/image_raw", "/rect/depth/image", "/camera/depth/image_unrect"] {
        let mut other = bag.clone();
        let folder = name.rsplit_once('/').unwrap().0;
        for message in &mut other.messages {
            match message.message_type {
                IMAGE => message.topic = name.to_owned(),
                CAMERA_INFO => message.topic = format!("{folder}/camera_info"),
                _ => {}
            }
        }
        assert_eq!(focal(&other), 8.0, "{name}");
    }
}

#[test]
fn a_file_stands_in() {
    let (folder, path) = without_info().write();
    let file = folder.path().join("info.yaml");
    let text = "width: 4\nheight: 3\nk: [6.0, 0.0, 2.0, 0.0, 6.0, 1.5, 0.0, 0.0, 1.0]\n";
    std::fs::write(&file, text).unwrap();
    let options = eyebolt_recording::BagOptions { camera_info: Some(file), ..Default::default() };
    let bag = eyebolt_recording::BagRecording::open(&path, &options).unwrap();
    assert_eq!(bag.camera().unwrap().fx(), 6.0);
    // What the file says of a rectified picture counts for one as it does from a topic.
    let file = options.camera_info.as_ref().unwrap();
    let p = "p: [7.0, 0.0, 2.0, 0.0, 0.0, 7.0, 1.5, 0.0, 0.0, 0.0, 1.0, 0.0]\n";
    std::fs::write(file, format!("{text}{p}")).unwrap();
    let mut rectified = without_info();
    for message in rectified.on(DEPTH_TOPIC) {
        message.topic = "/camera/depth/image_rect".to_owned();
    }
    rectified.options.camera_info = Some(file.clone());
    assert_eq!(rectified.open().camera().unwrap().fx(), 7.0);
    without_info().assert_says(&["no topic has the intrinsics", "`camera_info`"]);
}

#[test]
fn one_topic_tells_one_camera() {
    let mut bag = Bag::sample();
    info(&mut bag, INFO_TOPIC, FRAME, SIZE, 5.0);
    assert_eq!(focal(&bag), 5.0);
    info(&mut bag, INFO_TOPIC, FRAME, SIZE, 5.25);
    bag.assert_says(&[INFO_TOPIC, "the intrinsics change at 1700000000.002 s", "`camera_info`"]);
    let mut sizes = Bag::sample();
    info(&mut sizes, INFO_TOPIC, FRAME, (8, 6), 5.0);
    sizes.assert_says(&["the intrinsics change"]);
}

#[test]
fn a_camera_without_calibration_is_refused() {
    let mut bag = without_info();
    info(&mut bag, INFO_TOPIC, FRAME, SIZE, 0.0);
    bag.assert_says(&[INFO_TOPIC, "the focal length is 0 x 0", "`camera_info`"]);
}

#[test]
fn a_camera_of_another_size_is_refused_with_the_frame() {
    let mut bag = without_info();
    info(&mut bag, INFO_TOPIC, FRAME, (8, 6), 5.0);
    let parts =
        [DEPTH_TOPIC, "at 1700000000.005 s", "the image is 4 x 3", "is 8 x 6", "`camera_info`"];
    super::sample::assert_says(bag.open().read_frame(0), &parts);
}

/// Intrinsics of a sensor that pictures show a part of, binned.
struct Sensor {
    size: (u32, u32),
    binning: [u32; 2],
    /// x, y, height, width.
    roi: [u32; 4],
}

impl Sensor {
    fn info(&self) -> Vec<u8> {
        let k = [10.0, 0.0, 4.5, 0.0, 12.0, 3.5, 0.0, 0.0, 1.0];
        let cdr = writer::Cdr::with_header(START_NS, FRAME).u32(self.size.1).u32(self.size.0);
        let cdr = cdr.text("plumb_bob").count(0).f64s(&k).f64s(&[0.0; 21]);
        self.binning.iter().chain(&self.roi).fold(cdr, |cdr, n| cdr.u32(*n)).u8(0).done()
    }

    fn camera(&self) -> [f64; 4] {
        let mut bag = without_info();
        bag.add(INFO_TOPIC, CAMERA_INFO, START_NS, self.info());
        let bag = bag.open();
        let camera = bag.camera().unwrap();
        assert_eq!((camera.width(), camera.height()), SIZE);
        bag.read_frame(0).unwrap();
        [camera.fx(), camera.fy(), camera.cx(), camera.cy()]
    }
}

#[test]
fn pictures_of_a_binned_sensor_or_a_part_of_it_have_its_intrinsics() {
    let sensor = |size, binning, roi| Sensor { size, binning, roi }.camera();
    assert_eq!(sensor((8, 6), [2, 2], [0; 4]), [5.0, 6.0, 2.25, 1.75]);
    assert_eq!(sensor((8, 3), [2, 0], [0; 4]), [5.0, 12.0, 2.25, 3.5]);
    assert_eq!(sensor((9, 7), [1, 1], [3, 2, 3, 4]), [10.0, 12.0, 1.5, 1.5]);
    // Binned is what is cut out.
    assert_eq!(sensor((20, 20), [2, 2], [1, 2, 6, 8]), [5.0, 6.0, 1.75, 0.75]);
    // Some drivers tell what is of the picture, and binning beside it.
    assert_eq!(sensor(SIZE, [2, 2], [0; 4]), [10.0, 12.0, 4.5, 3.5]);
    let mut other = without_info();
    let info = Sensor { size: (16, 12), binning: [2, 2], roi: [0; 4] }.info();
    other.add(INFO_TOPIC, CAMERA_INFO, START_NS, info);
    super::sample::assert_says(other.open().read_frame(0), &["the image is 4 x 3", "16 x 12"]);
}

#[test]
fn intrinsics_of_nothing_but_the_rectified_picture_are_taken() {
    let mut bag = without_info();
    let mut data = writer::camera_info(START_NS, FRAME, SIZE, 8.0);
    // As depthai-ros tells it: K all zero, P filled.
    let k: Vec<u8> = [8.0, 0.0, 2.0, 0.0, 8.0, 1.5, 0.0, 0.0, 1.0_f64]
        .into_iter()
        .flat_map(f64::to_le_bytes)
        .collect();
    let at = data.windows(k.len()).position(|window| window == k).unwrap();
    data[at..at + k.len()].fill(0);
    bag.add(INFO_TOPIC, CAMERA_INFO, START_NS, data);
    assert_eq!(focal(&bag), 4.0);
}
