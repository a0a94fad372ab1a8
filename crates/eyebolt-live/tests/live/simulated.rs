//! A simulated recording, message by message.

use eyebolt::robots::BuiltIn;
use eyebolt::simulate::{Faults, Scenario, Viewpoint, plan};
use eyebolt_live::Incoming;
use eyebolt_registration::LinkCache;
use eyebolt_render::Sensor;
use std::fs;
use std::io::BufWriter;
use std::path::Path;

/// Configurations of the recording, and frames at rest in each.
pub const CONFIGURATIONS: usize = 6;
const FRAMES: usize = 14;

/// Writes a recording of the built-in arm to `path`.
pub fn record(path: &Path, seed: u64) {
    let robot = BuiltIn::named("shackle").unwrap();
    let arm = robot.arm();
    let viewpoint = Viewpoint::Preset(
        eyebolt::simulate::PRESETS.iter().find(|p| p.name == "paper-test-p1").unwrap(),
    );
    let scenario = Scenario {
        arm: &arm,
        urdf: robot.urdf,
        sensor: Sensor::KINECT_V1,
        viewpoint,
        configurations: CONFIGURATIONS,
        frames: FRAMES,
        moving_frames: 4,
        backgrounds: 0,
        clutter: 6,
        faults: Faults::default(),
        seed,
    };
    let plan = plan(scenario, &LinkCache::disabled()).unwrap();
    plan.record(BufWriter::new(fs::File::create(path).unwrap()), &()).unwrap();
}

/// The messages of the MCAP at `path`, as a recorder wrote them down.
pub fn messages(path: &Path) -> Vec<Incoming> {
    let file = fs::read(path).unwrap();
    let stream = mcap::MessageStream::new(&file).unwrap().map(|message| {
        let message = message.unwrap();
        Incoming {
            topic: message.channel.topic.clone(),
            message_type: message.channel.schema.as_ref().unwrap().name.clone(),
            data: message.data.to_vec(),
            received_ns: message.log_time.try_into().unwrap(),
            lost_before: 0,
        }
    });
    stream.collect()
}
