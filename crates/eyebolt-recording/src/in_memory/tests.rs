use super::*;
use crate::recording::Recording;
use crate::write::{WriteRobot, write_folder, write_mcap};
use crate::{BagOptions, depth_from_millimetres};
use eyebolt_geometry::Distortion;
use nalgebra::Point3;
use std::fs::File;

fn camera() -> PinholeCamera {
    PinholeCamera::new(4, 3, 5.0, 5.0, 1.5, 1.0, Distortion::None).unwrap()
}

fn depth(metres: f32) -> DepthImage {
    DepthImage::new(4, 3, (0..12).map(|i| metres + 0.01 * i as f32).collect()).unwrap()
}

fn joints(positions: &[f64]) -> JointPositions {
    (1..).zip(positions).map(|(i, position)| (format!("joint_{i}"), *position)).collect()
}

fn mask(set: usize) -> Mask {
    Mask::new(4, 3, (0..12).map(|i| i < set).collect()).unwrap()
}

fn cloud(z: f32) -> Cloud {
    Cloud::new((0..8).map(|i| Point3::new(0.01 * i as f32, 0.0, z)).collect())
}

fn three() -> InMemory {
    let mut frames = InMemory::new(camera()).with_camera_frame_id("optical");
    for (index, name) in ["a", "b", "7"].iter().enumerate() {
        let pushed = frames.push(*name, depth(1.0 + index as f32), joints(&[0.1, -0.2]));
        assert_eq!(pushed.unwrap(), index);
        frames.set_mask(index, mask(index + 1)).unwrap();
    }
    assert_eq!(frames.push_background(depth(4.0)).unwrap(), 0);
    frames
}

#[track_caller]
fn assert_says<T: std::fmt::Debug>(result: Result<T, RecordingError>, parts: &[&str]) {
    let text = result.unwrap_err().to_string();
    assert!(parts.iter().all(|part| text.contains(part)), "not {parts:?} in: {text}");
}

/// Every frame and background of both is the same.
fn assert_same(a: &dyn FrameSource, b: &dyn FrameSource) {
    assert_eq!(a.frame_names(), b.frame_names());
    assert_eq!((a.camera(), a.camera_frame_id()), (b.camera(), b.camera_frame_id()));
    for index in 0..a.frame_names().len() {
        let (a, b) = (a.read_frame(index).unwrap(), b.read_frame(index).unwrap());
        assert_eq!((&a.name, &a.mask, &a.joints), (&b.name, &b.mask, &b.joints));
        match (&a.range, &b.range) {
            (Range::Depth(a), Range::Depth(b)) => assert_eq!(a, b),
            (Range::Cloud(a), Range::Cloud(b)) => assert_eq!(a.points(), b.points()),
            _ => panic!("one is depth, one a cloud"),
        }
    }
    assert_eq!(a.background_count(), b.background_count());
    for index in 0..a.background_count() {
        assert_eq!(a.read_background(index).unwrap(), b.read_background(index).unwrap());
    }
}

#[test]
fn what_was_put_in_comes_out() {
    let frames = three();
    assert_eq!(frames.frame_names(), ["a", "b", "7"]);
    let frame = frames.read_frame(1).unwrap();
    assert!(matches!(&frame.range, Range::Depth(image) if *image == depth(2.0)));
    assert_eq!((frame.mask, frame.joints), (Some(mask(2)), joints(&[0.1, -0.2])));
    assert!(frames.has_masks() && frames.read_color(0).unwrap().is_none());
    assert!(matches!(frames.read_frame(3), Err(RecordingError::NoSuchFrame { count: 3, .. })));
    let error = frames.read_background(1);
    assert!(matches!(error, Err(RecordingError::NoSuchBackground { count: 1, .. })));
}

#[test]
fn frames_are_appended_later() {
    let mut frames = three();
    let color = ColorImage { width: 4, height: 3, rgb: vec![[1, 2, 3]; 12] };
    let index = frames.push("later", depth(1.5), joints(&[0.3])).unwrap();
    frames.set_color(index, color.clone()).unwrap();
    assert_eq!(frames.frame_names().len(), 4);
    assert_eq!(frames.read_color(index).unwrap(), Some(color));
}

#[test]
fn written_to_a_folder_or_a_bag_it_is_the_same() {
    let frames = three();
    let (folder, robot) = (tempfile::tempdir().unwrap(), WriteRobot::default());
    let recording = Recording::Other(Box::new(frames.clone()));
    let go_on = &();
    write_folder(&recording, &robot, folder.path(), go_on).unwrap();
    let read = Recording::open(folder.path(), &BagOptions::default()).unwrap();
    // Files are listed by number, then by name.
    let mut sorted = read.frame_names().to_vec();
    sorted.sort_by_key(|name| frames.frame_names().iter().position(|known| known == name));
    assert_eq!(sorted, frames.frame_names());
    let path = folder.path().join("written.mcap");
    write_mcap(&recording, &robot, File::create(&path).unwrap(), go_on).unwrap();
    let read = Recording::open(&path, &BagOptions::default()).unwrap();
    assert_same(&frames, read.source());
}

#[test]
fn what_does_not_fit_is_refused_with_the_frame() {
    let mut frames = three();
    let small = DepthImage::new(2, 2, vec![1.0; 4]).unwrap();
    let at_rest = || joints(&[0.0]);
    let said = ["in memory: frame x: depth: it is 2 x 2, but the camera is 4 x 3"];
    assert_says(frames.push("x", small.clone(), at_rest()), &said);
    assert_says(frames.push("a", depth(1.0), at_rest()), &["frame a", "of this name"]);
    assert_says(frames.push("../x", depth(1.0), at_rest()), &["frame ../x", "name of a file"]);
    assert_says(frames.push("x", depth(1000.0), at_rest()), &["frame x", "millimetres"]);
    assert_says(frames.push("x", depth(1.0), joints(&[])), &["frame x: joints: there are none"]);
    let infinite = joints(&[0.0, f64::INFINITY]);
    assert_says(frames.push("x", depth(1.0), infinite), &["frame x", "joint_2 is inf"]);
    assert_says(frames.push("x", depth(1.0), joints(&[90.0])), &["frame x", "like degrees"]);
    assert_says(frames.push_cloud("x", cloud(1.0), at_rest()), &["frame x", "are depth images"]);
    assert_says(frames.set_mask(0, mask(0)), &["frame a: mask: no pixel is set"]);
    let other = Mask::new(2, 2, vec![true; 4]).unwrap();
    assert_says(frames.set_mask(0, other), &["frame a: mask: it is 2 x 2, the frame 4 x 3"]);
    assert_says(frames.push_background(small), &["background 1: depth: it is 2 x 2"]);
    let color = ColorImage { width: 4, height: 3, rgb: vec![[0; 3]; 11] };
    assert_says(frames.set_color(0, color), &["frame a: color", "not its number of pixels"]);
    let nothing = depth_from_millimetres(4, 3, &[0; 12]).unwrap();
    let error = frames.push("x", nothing, at_rest()).unwrap_err();
    assert!(matches!(&error, RecordingError::EmptyFrame { .. }), "{error}");
    assert_eq!(frames.frame_names().len(), 3);
    assert!(frames.push("x", depth(1.0), at_rest()).is_ok());
}

#[test]
fn clouds_need_no_camera() {
    let mut frames = InMemory::of_clouds().named("queue");
    let said = ["queue: frame 0: depth: there is no camera"];
    assert_says(frames.push("0", depth(1.0), joints(&[0.0])), &said);
    frames.push_cloud("0", cloud(1.0), joints(&[0.0])).unwrap();
    let said = ["queue: frame 0: mask: the cloud is a list of points"];
    assert_says(frames.set_mask(0, mask(3)), &said);
    assert_says(frames.push_background(depth(1.0)), &["queue: background 0", "no camera"]);
    let empty = Cloud::new(vec![Point3::new(f32::NAN, 0.0, 0.0)]);
    let error = frames.push_cloud("1", empty, joints(&[0.0])).unwrap_err();
    assert!(matches!(error, RecordingError::EmptyFrame { .. }));
}
