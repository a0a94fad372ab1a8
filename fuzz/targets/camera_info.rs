//! Camera intrinsics in YAML.
#![no_main]

use eyebolt_recording::fuzzing;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    fuzzing::camera_info(text);
});
