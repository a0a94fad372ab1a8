//! What is written comes back.

use crate::made::{HAND, KINECT, labelled};
use crate::stage::ARM;
use eyebolt::dataset::Description;
use eyebolt_recording::FrameSource;

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
