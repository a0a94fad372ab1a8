//! Depth, masks and colours of a frame.

use super::sample::{Bag, DEPTH_TOPIC, FRAME, IMAGE, MS, PIXELS, SIZE, START_NS, assert_says};
use super::writer;
use eyebolt_recording::{
    BagOptions, BagRecording, DepthUnit, FrameSource, Range, Recording, WriteRobot, write_folder,
    write_mcap,
};

/// Replaces every depth image.
fn with_depth(encoding: &str, data: &[u8]) -> Bag {
    let mut bag = Bag::sample();
    for message in bag.on(DEPTH_TOPIC) {
        message.data = writer::image(message.log_time_ns, FRAME, encoding, SIZE, data);
    }
    bag
}

fn bytes<const N: usize>(values: &[[u8; N]]) -> Vec<u8> {
    values.concat()
}

#[test]
fn depth_is_in_metres() {
    let expected: Vec<f32> = (0..12).map(|pixel| 1.0 + 0.01 * pixel as f32).collect();
    assert_eq!(Bag::sample().open().depth_m(0), expected);
    let mut millimetres = [1250_u16; PIXELS];
    millimetres[3] = 0;
    millimetres[4] = u16::MAX;
    let depth = with_depth("16UC1", &bytes(&millimetres.map(u16::to_le_bytes))).open().depth_m(0);
    assert_eq!((depth[0], depth[3], depth[4]), (1.25, 0.0, 0.0));
}

#[test]
fn units_must_be_plausible() {
    let float_mm = bytes(&[1250.0_f32; PIXELS].map(f32::to_le_bytes));
    let read = with_depth("32FC1", &float_mm).open();
    assert_says(read.read_frame(0), &[DEPTH_TOPIC, "looks like millimetres", "REP 118"]);
    let integer_m = bytes(&[2_u16; PIXELS].map(u16::to_le_bytes));
    let read = with_depth("16UC1", &integer_m).open();
    assert_says(read.read_frame(0), &[DEPTH_TOPIC, "looks like metres", "REP 118"]);
}

#[test]
fn compressed_depth_is_read() {
    let mut bag = Bag::sample();
    let mut png = vec![0; 12];
    let mut encoder = png::Encoder::new(&mut png, SIZE.0, SIZE.1);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Sixteen);
    let data = bytes(&[1250_u16; PIXELS].map(u16::to_be_bytes));
    encoder.write_header().unwrap().write_image_data(&data).unwrap();
    for message in bag.on(DEPTH_TOPIC) {
        message.topic = format!("{DEPTH_TOPIC}/compressedDepth");
        message.message_type = "sensor_msgs/CompressedImage";
        let format = "16UC1; compressedDepth png";
        message.data = writer::compressed(message.log_time_ns, FRAME, format, &png);
    }
    let read = bag.open();
    assert_eq!(read.depth_m(0), [1.25; PIXELS]);
    assert_eq!(read.frame_names(), Bag::sample().open().frame_names());
    // Its intrinsics are beside the picture that was compressed.
    assert_eq!(read.role("intrinsics").as_deref(), Some("/camera/depth/camera_info"));
}

/// Of its size only the reading tells: the first picture that is compressed is as large as the depth.
#[test]
fn a_picture_that_does_not_fit_does_not_stop_a_copy_of_a_damaged_bag() {
    let mut bag = Bag::sample();
    let small = png_color((2, 2), [9; 3]);
    for (stamp, png) in [(START_NS + 90 * MS, png_color(SIZE, [9; 3])), (START_NS + 5 * MS, small)]
    {
        let data = writer::compressed(stamp, FRAME, "rgb8; png compressed bgr8", &png);
        // The one that fits was written down first.
        let log_time = 2 * START_NS + 100 * MS - stamp;
        bag.add("/color", "sensor_msgs/CompressedImage", log_time, data);
    }
    bag.options.color_topic = Some("/color".to_owned());
    for partial in [false, true] {
        bag.options.partial = partial;
        let (folder, path) = bag.write();
        let recording = Recording::open(&path, &bag.options).unwrap();
        assert_says(recording.read_color(0), &["/color", "the picture is 2 x 2, the camera 4 x 3"]);
        let go_on = &();
        let files = folder.path().join("files");
        std::fs::create_dir(&files).unwrap();
        let written = write_folder(&recording, &WriteRobot::default(), &files, go_on);
        assert_eq!(written.is_ok(), partial);
    }
}

/// A picture of one colour.
fn png_color(size: (u32, u32), rgb: [u8; 3]) -> Vec<u8> {
    let mut png = Vec::new();
    let mut encoder = png::Encoder::new(&mut png, size.0, size.1);
    encoder.set_color(png::ColorType::Rgb);
    let data = rgb.repeat((size.0 * size.1) as usize);
    encoder.write_header().unwrap().write_image_data(&data).unwrap();
    png
}

#[test]
fn compressed_colours_are_read() {
    let jpeg = include_bytes!("../fixtures/color.jpg");
    for (format, data) in
        [("png", png_color(SIZE, [200, 100, 0])), ("rgb8; jpeg compressed bgr8", jpeg.to_vec())]
    {
        let mut bag = Bag::sample();
        let message = |data: &[u8]| writer::compressed(START_NS + 5 * MS, FRAME, format, data);
        let kind = "sensor_msgs/CompressedImage";
        bag.add("/color/compressed", kind, START_NS, message(&data));
        let read = bag.open();
        assert_eq!(read.role("color").as_deref(), Some("/color/compressed"), "{format}");
        let color = read.read_color(0).unwrap().unwrap();
        assert_eq!((color.width, color.height, color.rgb.len()), (4, 3, PIXELS));
        let near = |a: [u8; 3], b: [u8; 3]| a.iter().zip(b).all(|(a, b)| a.abs_diff(b) < 60);
        match format {
            "png" => assert!(color.rgb.iter().all(|rgb| *rgb == [200, 100, 0])),
            _ => {
                assert!(near(color.rgb[0], [255, 0, 0]), "{:?}", color.rgb);
                assert!(near(color.rgb[3], [0, 0, 255]), "{:?}", color.rgb);
            }
        }
        // A raw topic with the same pictures is the better one.
        let rgb = writer::image(START_NS + 5 * MS, FRAME, "rgb8", SIZE, &[9; 3 * PIXELS]);
        bag.add("/color", IMAGE, START_NS, rgb);
        assert_eq!(bag.open().role("color").as_deref(), Some("/color"));
        // Cut short, it is damaged.
        let mut cut = Bag::sample();
        cut.add("/color", kind, START_NS, message(&data[..data.len() / 2]));
        cut.options.color_topic = Some("/color".to_owned());
        if let Ok(opened) = cut.try_open() {
            assert!(opened.read_color(0).is_err() || format != "png");
        }
    }
    let mut odd = Bag::sample();
    let data = writer::compressed(START_NS + 5 * MS, FRAME, "jpeg", b"GIF89a");
    odd.add("/color", "sensor_msgs/CompressedImage", START_NS, data);
    odd.options.color_topic = Some("/color".to_owned());
    assert_says(odd.open().read_color(0), &["/color", "neither JPEG nor PNG"]);
}

#[test]
fn a_unit_that_is_told_goes_before_what_ros_says() {
    // Quarters of a millimetre in integers, and tenths in floats.
    let integers = with_depth("16UC1", &bytes(&[5000_u16; PIXELS].map(u16::to_le_bytes)));
    let floats = with_depth("32FC1", &bytes(&[12_500.0_f32; PIXELS].map(f32::to_le_bytes)));
    for (mut bag, unit) in [(integers, "0.00025"), (floats, "0.0001")] {
        bag.options.depth_unit = DepthUnit::parse(unit);
        let read = bag.open();
        assert!(read.depth_m(0).iter().all(|depth| (depth - 1.25).abs() < 1e-6));
        assert!(!read.in_millimetres());
        // A copy is of the same unit, without being told.
        let (folder, path) = bag.write();
        let recording = Recording::open(&path, &bag.options).unwrap();
        let copy = folder.path().join("copy.mcap");
        let file = std::fs::File::create(&copy).unwrap();
        write_mcap(&recording, &WriteRobot::default(), file, &()).unwrap();
        let copied = BagRecording::open(&copy, &BagOptions::default()).unwrap();
        let Range::Depth(depth) = copied.read_frame(0).unwrap().range else { panic!("a cloud") };
        assert_eq!(depth.depth_m(), read.depth_m(0));
    }
}
fn masks(encoding: &str, size: (u32, u32), data: &[u8]) -> Bag {
    let mut bag = Bag::sample();
    for i in 0..60 {
        let stamp = START_NS + 100 * MS * i + 15 * MS;
        bag.add("/arm_mask", IMAGE, stamp, writer::image(stamp, FRAME, encoding, size, data));
    }
    bag
}

#[test]
fn masks_mark_the_arm() {
    let mut set = [0; PIXELS];
    set[5] = 1;
    let bag = masks("mono8", SIZE, &set).open();
    assert!(bag.has_masks());
    let mask = bag.read_frame(0).unwrap().mask.unwrap();
    assert_eq!((mask.count(), mask.width(), mask.height()), (1, 4, 3));
    assert!(!Bag::sample().open().has_masks());
}

#[test]
fn masks_must_fit() {
    assert_says(
        masks("mono8", SIZE, &[0; PIXELS]).open().read_frame(0),
        &["/arm_mask", "no pixel of the mask is set"],
    );
    let mut other = masks("mono8", (2, 2), &[1; 4]);
    // Of another size, they are not taken by themselves.
    assert!(!other.open().has_masks());
    other.options.mask_topic = Some("/arm_mask".to_owned());
    let parts = ["/arm_mask at 1700000000.015 s", "the mask is 2 x 2, the frame 4 x 3"];
    assert_says(other.open().read_frame(0), &parts);
    let mut colored = masks("rgb8", SIZE, &[1; 3 * PIXELS]);
    colored.options.mask_topic = Some("/arm_mask".to_owned());
    assert_says(colored.open().read_frame(0), &["\"rgb8\" is no mask"]);
}

fn colors(stamps_ms: &[i64], size: (u32, u32)) -> Bag {
    let mut bag = Bag::sample();
    for (i, ms) in stamps_ms.iter().enumerate() {
        let stamp = START_NS + ms * MS;
        let data = vec![i as u8; 3 * (size.0 * size.1) as usize];
        bag.add("/color", IMAGE, stamp, writer::image(stamp, FRAME, "bgr8", size, &data));
    }
    bag
}

#[test]
fn the_colour_picture_is_the_nearest_in_time() {
    // Frames are at 5, 105, 205... ms.
    let bag = colors(&[20, 90, 130, 260], SIZE).open();
    let value = |index: usize| bag.read_color(index).unwrap().map(|color| color.rgb[0][0]);
    assert_eq!([value(0), value(1), value(2), value(3)], [Some(0), Some(1), None, Some(3)]);
    assert!(Bag::sample().open().read_color(0).unwrap().is_none());
}

#[test]
fn colours_must_be_of_the_camera() {
    let mut bag = colors(&[5], (8, 6));
    assert!(bag.open().read_color(0).unwrap().is_none());
    bag.options.color_topic = Some("/color".to_owned());
    bag.assert_says(&["`color_topic`: /color is 8 x 6, the depth 4 x 3", "those of the depth"]);
}

#[test]
fn of_several_masks_one_is_to_be_named() {
    let mut bag = masks("mono8", SIZE, &[255; PIXELS]);
    bag.add(
        "/other_mask",
        IMAGE,
        START_NS,
        writer::image(START_NS, FRAME, "mono8", SIZE, &[1; 12]),
    );
    bag.assert_says(&["`mask_topic`", "/arm_mask, /other_mask"]);
    bag.options.mask_topic = Some("/arm_mask".to_owned());
    assert!(bag.open().has_masks());
}

#[test]
fn masks_of_compressed_depth_are_found_by_the_size_of_the_camera() {
    let mut bag = masks("mono8", SIZE, &[255; PIXELS]);
    for message in bag.on(DEPTH_TOPIC) {
        message.message_type = "sensor_msgs/CompressedImage";
        let format = "16UC1; compressedDepth png";
        message.data = writer::compressed(message.log_time_ns, FRAME, format, &[0; 12]);
    }
    assert!(bag.open().has_masks());
}

#[test]
fn a_damaged_colour_costs_a_picture_and_no_more() {
    let mut bag = Bag::sample();
    let data = writer::image(START_NS, FRAME, "rgb8", SIZE, &[9; 36]);
    bag.add("/color", IMAGE, START_NS + 5 * MS, data.clone());
    bag.add("/color", IMAGE, START_NS + 105 * MS, data[..40].to_vec());
    let read = bag.open();
    assert_eq!(read.role("color").as_deref(), Some("/color"));
    assert!(read.read_color(0).unwrap().is_some() && read.read_color(1).unwrap().is_none());
}

#[test]
fn what_is_no_depth_is_not_taken_for_it() {
    let mut bag = Bag::sample();
    for message in bag.clone().on(DEPTH_TOPIC) {
        let mut other = message.clone();
        other.topic = "/camera/confidence/confidence_map".to_owned();
        bag.messages.push(other);
    }
    assert_eq!(bag.open().role("depth").as_deref(), Some(DEPTH_TOPIC));
}

/// The pictures of a colour camera 0.16 m beside the depth camera, twice as large.
#[test]
fn colours_of_another_camera_are_seen_from_the_depths() {
    let mut bag = Bag::sample();
    for message in bag.on(DEPTH_TOPIC) {
        // In all pixels two metres: the baseline is 0.8 pixels of colour.
        message.data = writer::depth(message.log_time_ns, FRAME, SIZE, &[2.0; PIXELS]);
    }
    let size = (2 * SIZE.0, 2 * SIZE.1);
    let rgb: Vec<u8> = (0..48).flat_map(|i| [i % 8, i / 8, 200]).collect();
    let stamp = START_NS + 5 * MS;
    let picture = writer::image(stamp, "color_optical", "rgb8", size, &rgb);
    bag.add("/camera/color/image_raw", IMAGE, stamp, picture);
    let mut without_tree = bag.clone();
    // Its principal point is at (4, 3), that of the depth at (2, 1.5).
    let info = writer::camera_info(stamp, "color_optical", size, 10.0);
    bag.add("/camera/color/camera_info", "sensor_msgs/CameraInfo", stamp, info);
    for (child, x) in [(FRAME, 0.0), ("color_optical", -0.16)] {
        let cdr = writer::Cdr::new().count(1).i32(1).u32(2).text("camera_link").text(child);
        let data = cdr.f64s(&[x, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]).done();
        bag.add("/tf_static", "tf2_msgs/TFMessage", START_NS, data);
    }
    let read = bag.open();
    assert_eq!(read.role("color").as_deref(), Some("/camera/color/image_raw"));
    assert_eq!(read.role("color camera").as_deref(), Some("/camera/color/camera_info"));
    let color = read.read_color(0).unwrap().unwrap();
    assert_eq!((color.width, color.height), SIZE);
    // Pixel (u, v) of depth is at 2 u + 0.8 and 2 v there.
    for (index, pixel) in color.rgb.iter().enumerate() {
        let (u, v) = (index as f64 % 4.0, (index / 4) as f64);
        let expected = [(2.0 * u + 0.8).round() as u8, (2.0 * v) as u8, 200];
        assert_eq!(*pixel, expected, "pixel {index}");
    }
    // Without the tree, nobody knows where the colour camera is.
    assert!(without_tree.open().read_color(0).unwrap().is_none());
    without_tree.options.color_topic = Some("/camera/color/image_raw".to_owned());
    without_tree.assert_says(&["`color_topic`", "8 x 6, the depth 4 x 3", "/tf_static"]);
}
