//! Bags of ROS 1.
#![no_main]

use eyebolt_fuzz::{bag, file};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    bag(&file("recording.bag", bytes));
});
