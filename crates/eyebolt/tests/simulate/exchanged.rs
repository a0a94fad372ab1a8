//! Recordings in which two joints have each other's names.

use crate::stage::{ARM, CACHE, planned, preset, small};
use eyebolt::calibrate::{Reason, Verdict};
use eyebolt::pipeline::{self, Request};
use eyebolt::simulate::Scenario;
use eyebolt::study::Tampering;
use eyebolt_recording::InMemory;
use eyebolt_render::Sensor;

fn recording(viewpoint: &str, seed: u64) -> InMemory {
    let counts = Scenario { configurations: 6, frames: 1, backgrounds: 2, ..small() };
    let (sensor, viewpoint) = (Sensor::KINECT_V1, preset(viewpoint));
    planned(Scenario { sensor, viewpoint, seed, ..counts }).in_memory().unwrap()
}

fn verdict(source: &InMemory) -> Verdict {
    let request = Request { cache: CACHE.clone(), ..Request::new(source, &ARM) };
    pipeline::run(&request, &()).unwrap().calibration.verdict
}

#[test]
fn exchanged_wrist_joints_are_found_and_right_names_are_not_accused() {
    for (viewpoint, seed) in [("paper-test-p2", 2), ("paper-test-p3", 3)] {
        let right = recording(viewpoint, seed);
        assert_eq!(verdict(&right), Verdict::Trusted, "{viewpoint}");
        for pair in [["joint5", "joint6"], ["joint5", "joint7"], ["joint6", "joint7"]] {
            let joints = pair.map(str::to_owned);
            let wrong = Tampering::ExchangedJoints(joints.clone()).apply(&right, &ARM).unwrap();
            let verdict = verdict(&wrong);
            let Verdict::Refused(reasons) = &verdict else { panic!("{pair:?} is trusted") };
            let found = Reason::JointsExchanged { joints };
            assert!(reasons.contains(&found), "{viewpoint}, {pair:?}: {reasons:?}");
        }
    }
}
