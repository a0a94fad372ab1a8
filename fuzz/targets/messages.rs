//! Messages of ROS 1 and ROS 2, every type, with all that is decoded from them.
#![no_main]

use eyebolt_recording::fuzzing;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    fuzzing::messages(bytes);
});
