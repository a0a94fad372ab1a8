//! Joints in CSV and JSON, of one frame and of all.
#![no_main]

use eyebolt_fuzz::file;
use eyebolt_recording::fuzzing;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    for extension in ["csv", "json"] {
        fuzzing::joints(&file(&format!("joints.{extension}"), bytes), extension);
    }
});
