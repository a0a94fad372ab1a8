//! Clouds in PCD.
#![no_main]

use eyebolt_fuzz::file;
use eyebolt_recording::fuzzing;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    fuzzing::cloud(&file("cloud.pcd", bytes), "pcd");
});
