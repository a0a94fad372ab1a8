//! The description of a ROS 2 bag, `metadata.yaml`.
#![no_main]

use eyebolt_fuzz::{FOLDER, file, recording};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    file("bag_0.mcap", include_bytes!("../seeds/mcap/plain.mcap"));
    file("metadata.yaml", bytes);
    recording(&FOLDER);
});
