//! Bags in MCAP, compressed as a whole or not.
#![no_main]

use eyebolt_fuzz::{bag, file};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    bag(&file("bag.mcap", bytes));
});
