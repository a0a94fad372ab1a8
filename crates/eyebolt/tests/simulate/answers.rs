//! From nothing to an answer, against where the camera really was.

use crate::stage::{Recorded, planned, preset, shackle, small};
use eyebolt::answer::Answer;
use eyebolt::calibrate::Verdict;
use eyebolt::evaluate::Evaluation;
use eyebolt::pipeline;
use eyebolt::simulate::Scenario;
use eyebolt_recording::{RecordingInfo, RecordingWriter, Truth};
use eyebolt_render::Sensor;
use std::io::Cursor;

/// What a user would record in a minute, with a Kinect.
fn scenario(name: &str, seed: u64) -> Scenario<'static> {
    Scenario {
        sensor: Sensor::KINECT_V1,
        viewpoint: preset(name),
        configurations: 4,
        frames: 4,
        backgrounds: 4,
        clutter: 6,
        seed,
        ..small()
    }
}

/// Calibrates, wants trust and an answer within what can be reached; what became of the background.
fn assert_found(recorded: &Recorded, truth: &Truth) -> Option<&'static str> {
    let request = recorded.request();
    let outcome = pipeline::run(&request, &()).unwrap();
    let pose = outcome.calibration.camera_from_base.unwrap();
    let off = Evaluation::of(&pose, &truth.camera_from_base);
    assert_eq!(outcome.calibration.verdict, Verdict::Trusted, "{off:?}");
    assert!(off.translation_mm < 2.0 && off.rotation_deg < 0.15, "{off:?}");
    Answer::new(&request, &outcome).background
}

#[test]
fn from_the_right_with_backgrounds_and_without() {
    for (backgrounds, used) in [(4, Some("used")), (0, None)] {
        let recorded = Recorded::of(Scenario { backgrounds, ..scenario("paper-test-p1", 1) });
        assert_eq!(assert_found(&recorded, &recorded.truth), used);
    }
}

#[test]
fn from_the_front_with_backgrounds() {
    let recorded = Recorded::of(scenario("paper-test-p2", 2));
    assert_eq!(assert_found(&recorded, &recorded.truth), Some("used"));
}

#[test]
fn backgrounds_from_another_place_are_seen_through() {
    let here = Recorded::of(scenario("paper-test-p1", 1));
    let there = Recorded::of(Scenario { configurations: 1, ..scenario("paper-test-p2", 2) });
    let camera = Sensor::KINECT_V1.camera();
    let info = RecordingInfo {
        camera: &camera,
        camera_frame_id: "camera",
        in_millimetres: true,
        static_transforms: &[],
        urdf: Some(shackle().urdf),
        base: Some("link0"),
        end_effector: Some("hand"),
    };
    let mut output = Cursor::new(Vec::new());
    let mut writer = RecordingWriter::new(&mut output, &info).unwrap();
    for index in 0..there.recording.background_count() {
        let depth = there.recording.read_background(index).unwrap();
        writer.background(1_000_000_000 + index as i64 * 33_000_000, &depth).unwrap();
    }
    for (frame, joints) in here.joints().iter().enumerate() {
        let stamp_ns = here.recording.stamp_ns(frame);
        for offset_ns in [-15_000_000, 0, 15_000_000] {
            writer.joints(stamp_ns + offset_ns, joints).unwrap();
        }
        writer.depth(stamp_ns, &here.depth(frame)).unwrap();
    }
    writer.truth(&here.truth).unwrap();
    writer.finish().unwrap();
    let mixed = Recorded::of_bytes(&output.into_inner());
    assert_eq!((mixed.count(), mixed.recording.background_count()), (16, 4));
    assert_eq!(assert_found(&mixed, &here.truth), Some("of_another_scene"));
}

#[test]
fn a_robot_in_the_recording_is_robot_enough() {
    let plan = planned(small());
    let recorded = Recorded::of_plan(&plan);
    let urdf = recorded.recording.robot().description.as_deref();
    assert_eq!(urdf, Some(shackle().urdf));
}

/// Clocks that differ, with frames on the way, cost the trust in an answer or do no harm.
#[test]
fn clocks_that_differ_never_make_a_wrong_answer_trusted() {
    let mut scenario =
        Scenario { moving_frames: 20, backgrounds: 0, ..scenario("paper-test-p1", 1) };
    scenario.faults.time_skew_s = 0.3;
    let recorded = Recorded::of(scenario);
    let request = recorded.request();
    let calibration = pipeline::run(&request, &()).unwrap().calibration;
    let pose = calibration.camera_from_base;
    let off = pose.map(|pose| Evaluation::of(&pose, &recorded.truth.camera_from_base));
    let wrong = off.is_none_or(|off| off.translation_mm > 10.0 || off.rotation_deg > 0.8);
    assert!(calibration.verdict != Verdict::Trusted || !wrong, "{off:?}");
}
