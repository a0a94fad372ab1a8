//! Frames without a file are those of the file.

use crate::stage::{AS_SAID, Recorded, SENSOR, apart, planned, small};
use eyebolt::simulate::{Faults, Lab, Scenario};
use eyebolt_recording::{FrameSource, Range};
use eyebolt_render::Sensor;

fn assert_as_recorded(scenario: Scenario<'static>) {
    let plan = planned(scenario);
    let (recorded, memory) = (Recorded::of_plan(&plan), plan.in_memory().unwrap());
    assert_eq!(memory.camera(), recorded.recording.camera());
    assert_eq!(memory.robot().base, recorded.recording.robot().base);
    assert_eq!(memory.robot().description, recorded.recording.robot().description);
    assert_eq!(memory.background_count(), recorded.recording.background_count());
    for index in 0..memory.background_count() {
        let background = memory.read_background(index).unwrap();
        assert_eq!(background, recorded.recording.read_background(index).unwrap());
    }
    assert_eq!(memory.frame_names().len(), recorded.count());
    for (index, joints) in recorded.joints().iter().enumerate() {
        let frame = memory.read_frame(index).unwrap();
        let Range::Depth(depth) = frame.range else { panic!("depth is images") };
        assert!(depth == recorded.depth(index), "frame {index}");
        assert!(apart(&frame.joints, joints) < 2.0 * AS_SAID);
    }
}

#[test]
fn frames_at_rest_are_those_of_the_file() {
    let wrong = Faults {
        bump: Some([0.02, 0.01]),
        backlash: 0.01,
        joint_offset_sigma: 0.003,
        depth_scale: 1.01,
        focal_scale: 1.02,
        ..Faults::default()
    };
    let seen = Scenario { backgrounds: 2, moving_frames: 2, ..small() };
    assert_as_recorded(Scenario { faults: wrong, sensor: Sensor::KINECT_V1, ..seen.clone() });
    let lab = Lab { gloss: 0.2, wander_m: 0.01, passers_by: 1, ..Lab::default() };
    assert_as_recorded(Scenario { faults: Faults { lab, ..Faults::default() }, ..seen });
}

#[test]
fn a_frame_that_sees_nothing_is_left_out() {
    // Nearer than the camera can see: nothing is left of it.
    let sensor = Sensor { range_m: [0.0, 0.05], ..SENSOR };
    let plan = planned(small());
    assert_eq!(plan.in_memory().unwrap().frame_names().len(), 4);
    let blind = eyebolt::simulate::plan(Scenario { sensor, ..small() }, &crate::stage::CACHE);
    // No hand is in range, so there is not even a plan.
    assert!(blind.is_err());
}
