//! What a simulation knows of its recording, in JSON.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| eyebolt_recording::fuzzing::truth(text));
