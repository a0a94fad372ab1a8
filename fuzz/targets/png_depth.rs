//! PNG: depth, masks, colour.
#![no_main]

use eyebolt_fuzz::file;
use eyebolt_recording::fuzzing;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    fuzzing::png(&file("picture.png", bytes));
});
