//! What is written comes back.

use crate::made::{Calibration, HAND, KINECT, labelled, scenario};
use crate::stage::{ARM, planned};
use eyebolt::dataset::{Dataset, Description, Shard};
use eyebolt_recording::{Frame, FrameSource, InMemory};
use eyebolt_render::Sensor;

#[test]
fn frames_come_back_as_they_were_labelled() {
    let (_folder, dataset) = labelled();
    assert_eq!(*dataset.description(), Description::new(&ARM, &HAND));
    assert_eq!(dataset.frames().len(), KINECT.source.frame_names().len());
    dataset.check_robot(&ARM).unwrap();
    let run = KINECT.run(&KINECT.source);
    for entry in dataset.frames() {
        let read = dataset.read(entry).unwrap();
        let made = run.frame(entry.number).unwrap().unwrap();
        assert_eq!(entry.name, KINECT.source.frame_names()[entry.number]);
        assert_eq!(read.depth, made.frame.depth);
        assert_eq!(read.labels, made.frame.labels);
        assert_eq!(read.keypoints, made.frame.keypoints);
        assert_eq!(read.keypoints_in_camera, made.frame.keypoints_in_camera);
        assert_eq!(read.camera, *run.camera());
        let apart = read.camera_from_end_effector.distance_to(&made.frame.camera_from_end_effector);
        assert!(apart.0 < 1e-12 && apart.1 < 1e-7, "{apart:?}");
        for name in HAND.joint_names() {
            assert_eq!(read.joints.get(name), made.joints.get(name));
        }
        let recording = dataset.recording(&entry.recording).unwrap();
        assert_eq!(dataset.calibration(&recording).unwrap(), KINECT.json);
    }
}

/// Nobody knows where they are, so nothing is said of them.
#[test]
fn fingers_that_nobody_recorded_are_nowhere() {
    let arm: Vec<&str> = ARM.required_joints();
    let mut bare = InMemory::new(KINECT.source.camera().unwrap().clone()).named("simulated");
    for index in 0..KINECT.source.background_count() {
        bare.push_background(KINECT.source.read_background(index).unwrap()).unwrap();
    }
    for index in 0..KINECT.source.frame_names().len() {
        let Frame { name, range, mask, joints } = KINECT.source.read_frame(index).unwrap();
        let told = joints.iter().filter(|(name, _)| arm.contains(name));
        let joints = told.map(|(name, at)| (name.to_owned(), at)).collect();
        bare.push_frame(Frame { name, range, mask, joints }).unwrap();
    }
    let plan = planned(scenario(Sensor::KINECT_V1, 2));
    let calibration = Calibration::of_source(plan, bare);
    let folder = tempfile::tempdir().unwrap();
    calibration.label(folder.path(), Shard::WHOLE).unwrap();
    let dataset = Dataset::open(folder.path()).unwrap();
    let link = |name: &str| ARM.robot().link_index(name).unwrap();
    let on_finger: Vec<bool> = dataset
        .description()
        .keypoints
        .iter()
        .map(|keypoint| ["left_finger", "right_finger"].map(link).contains(&link(&keypoint.link)))
        .collect();
    assert!(on_finger.contains(&true) && on_finger.contains(&false), "{on_finger:?}");
    for entry in dataset.frames() {
        let read = dataset.read(entry).unwrap();
        assert_eq!(read.joints.get("finger_joint1"), None);
        assert!(arm.iter().all(|name| read.joints.get(name).is_some()));
        for ((class, at), unknown) in (1..).zip(&read.keypoints_in_camera).zip(&on_finger) {
            assert_eq!(at.iter().all(|x| x.is_nan()), *unknown, "{class}");
            assert!(!*unknown || !read.keypoints.contains(&class), "{class}");
        }
    }
}
