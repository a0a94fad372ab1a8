//! Depth, backgrounds and truth through every kind of copy.

use crate::sample::{
    Backgrounds, Desk, MS, PIXELS, START_NS, assert_says, backgrounds, frames, image, joints,
    millimetres, open, transforms, truth, write,
};
use eyebolt_geometry::DepthImage;
use eyebolt_recording::{BagOptions, Recording, read_truth};
use proptest::prelude::*;
use std::fs;

fn bits(images: &[DepthImage]) -> Vec<Vec<u32>> {
    images.iter().map(|image| image.depth_m().iter().map(|z| z.to_bits()).collect()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn metres_stay_the_same_bit_by_bit(
        depths in proptest::collection::vec(
            proptest::collection::vec(prop_oneof![3 => 0.3_f32..8.0, 1 => Just(0.0)], PIXELS), 3..5),
        position in -3.0_f64..3.0,
    ) {
        // A frame that saw nothing is left out.
        let images: Vec<_> = depths.iter().map(|depth| {
            let mut depth = depth.clone();
            depth[0] = 0.5;
            image(&depth)
        }).collect();
        let desk = Desk::new();
        let path = desk.record("a.mcap", false, |writer| {
            for (index, image) in (0..).zip(&images) {
                for around in [-10, 0, 10] {
                    writer.joints(START_NS + (100 * index + around) * MS, &joints(position))?;
                }
                writer.depth(START_NS + 100 * index * MS, image)?;
                writer.background(START_NS + 100 * index * MS, image)?;
            }
            Ok(())
        });
        let recording = open(&path);
        prop_assert_eq!(bits(&frames(&recording)), bits(&images));
        prop_assert_eq!(bits(&backgrounds(&recording)), bits(&images));
        let read = recording.read_joints(1).unwrap();
        prop_assert_eq!(read.get("elbow").map(f64::to_bits), Some(position.to_bits()));
    }
}

/// Checks what [`write`] wrote.
#[track_caller]
fn assert_whole(recording: &Recording, in_millimetres: bool) {
    assert_eq!(bits(&frames(recording)), bits(&[0, 1, 2, 3, 4].map(millimetres)));
    assert_eq!(bits(&backgrounds(recording)), bits(&[100, 101].map(millimetres)));
    assert_eq!(recording.in_millimetres(), in_millimetres);
    assert_eq!(recording.camera_frame_id(), Some("eye_optical"));
    assert_eq!(recording.static_transforms(), transforms());
    assert_eq!(recording.robot().base.as_deref(), Some("base_link"));
    assert_eq!(recording.read_joints(4).unwrap(), joints(0.75));
    assert_says(recording.read_background(2), &["background index 2", "2 backgrounds"]);
}

#[test]
fn there_and_back_nothing_is_lost() {
    for in_millimetres in [false, true] {
        for order in [Backgrounds::Before, Backgrounds::After] {
            let desk = Desk::new();
            let mcap = desk.record("a.mcap", in_millimetres, |writer| {
                writer.truth(&truth())?;
                write(writer, order)
            });
            let folder = desk.folder(&mcap, "folder");
            let back = desk.mcap(&folder, "back.mcap");
            let copy = desk.mcap(&mcap, "copy.mcap");
            let copy = desk.mcap(&copy, "copy_of_copy.mcap");
            for path in [&mcap, &folder, &back, &copy, &desk.folder(&back, "again")] {
                assert_whole(&open(path), in_millimetres);
                assert_eq!(read_truth(path).unwrap(), read_truth(&mcap).unwrap());
            }
            let said = fs::read_to_string(folder.join("truth.json")).unwrap();
            assert_eq!(said, truth().to_json());
            let again = fs::read_to_string(desk.file("again").join("truth.json")).unwrap();
            assert_eq!(again, said);
        }
    }
}

#[test]
fn a_recording_without_backgrounds_or_truth_gets_none() {
    let desk = Desk::new();
    let mcap = desk.record("a.mcap", true, |writer| write(writer, Backgrounds::None));
    let folder = desk.folder(&mcap, "folder");
    let back = desk.mcap(&folder, "back.mcap");
    for path in [&mcap, &folder, &back] {
        assert_eq!(open(path).background_count(), 0);
        assert_says(open(path).read_background(0), &["background index 0", "0 backgrounds"]);
        assert_says(read_truth(path), &["no truth in it: only simulated recordings know it"]);
    }
    let names = fs::read_dir(&folder).unwrap().map(|file| file.unwrap().file_name());
    assert!(!names.into_iter().any(|name| name == "truth.json" || name == "background_0.png"));
}

#[test]
fn backgrounds_are_no_frames_and_are_called_what_they_are() {
    let desk = Desk::new();
    let path = desk.record("a.mcap", true, |writer| write(writer, Backgrounds::After));
    let recording = open(&path);
    let topics = recording.bag().unwrap().topics();
    let role = |role| topics.iter().find(|topic| topic.role == Some(role)).map(|t| &*t.name);
    assert_eq!(role("depth"), Some("/camera/depth/image_raw"));
    assert_eq!(role("background"), Some("/camera/depth/background/image_raw"));
    // Whoever wants them as frames may say so.
    let depth_topic = role("background").map(str::to_owned);
    let options = BagOptions { depth_topic, max_motion: Some(0.1), ..BagOptions::default() };
    let error = Recording::open(&path, &options);
    // The joints were not told then.
    assert_says(error, &["/camera/depth/background/image_raw", "none of its 2 frames"]);
}

#[test]
fn a_scene_out_of_range_is_a_background() {
    let desk = Desk::new();
    let path = desk.record("a.mcap", true, |writer| {
        writer.background(START_NS, &image(&[0.0; PIXELS]))?;
        write(writer, Backgrounds::None)
    });
    let folder = desk.folder(&path, "folder");
    for path in [&path, &folder, &desk.mcap(&folder, "back.mcap")] {
        assert_eq!(backgrounds(&open(path)), [image(&[0.0; PIXELS])]);
    }
}

#[test]
fn what_a_killed_writer_left_has_no_background() {
    let desk = Desk::new();
    let path = desk.record("a.mcap", false, |writer| {
        write(writer, Backgrounds::None)?;
        // Another chunk than the frames, which is lost.
        for step in 0..60_000 {
            writer.joints(START_NS + 600 * MS + step, &joints(0.75))?;
        }
        writer.background(START_NS + 700 * MS, &millimetres(100))
    });
    let whole = fs::read(&path).unwrap();
    let name = b"background_topic";
    let named = whole.windows(name.len()).position(|bytes| bytes == name).unwrap();
    fs::write(&path, &whole[..named + 100]).unwrap();
    assert_says(Recording::open(&path, &BagOptions::default()), &["`partial`"]);
    let options = BagOptions { partial: true, ..BagOptions::default() };
    let recording = Recording::open(&path, &options).unwrap();
    assert_eq!((recording.frame_names().len(), recording.background_count()), (5, 0));
}
