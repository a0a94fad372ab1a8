//! Integers of depth that are not the millimetres that the recording says.

use crate::stage::{ARM, CACHE, bytes, planned, preset, small};
use eyebolt::calibrate::{Reason, Verdict};
use eyebolt::pipeline::{self, Request};
use eyebolt::simulate::Scenario;
use eyebolt_recording::{BagOptions, BagRecording, DepthUnit};
use eyebolt_render::Sensor;
use std::io::Cursor;

fn verdict(bytes: &[u8], unit_m: f64) -> Verdict {
    let depth_unit = DepthUnit::of_metres(unit_m);
    let options = BagOptions { depth_unit, ..BagOptions::default() };
    let bag = BagRecording::from_reader("session", Cursor::new(bytes.to_vec()), &options).unwrap();
    let request = Request { cache: CACHE.clone(), ..Request::new(&bag, &ARM) };
    pipeline::run(&request, &()).unwrap().calibration.verdict
}

#[test]
fn a_factor_between_units_is_named_and_not_blamed_on_joints() {
    let counts = Scenario { configurations: 6, frames: 1, backgrounds: 2, ..small() };
    let (sensor, viewpoint) = (Sensor::KINECT_V1, preset("paper-test-p2"));
    let bytes = bytes(&planned(Scenario { sensor, viewpoint, seed: 2, ..counts }));
    // The camera stores millimetres.
    assert_eq!(verdict(&bytes, 1e-3), Verdict::Trusted);
    for said_m in [4e-3, 2.5e-4] {
        let Verdict::Refused(reasons) = verdict(&bytes, said_m) else {
            panic!("{said_m} is trusted")
        };
        let [Reason::DepthUnit { unit_m, fitting_m }] = reasons[..] else { panic!("{reasons:?}") };
        assert_eq!(unit_m, said_m);
        assert!((fitting_m - 1e-3).abs() < 1e-9, "{fitting_m}");
        assert!(reasons[0].to_string().contains("argument `depth_unit`"), "{}", reasons[0]);
    }
}
