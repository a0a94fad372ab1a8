//! Bags of ROS 2 in SQLite.
#![no_main]

use eyebolt_fuzz::{FOLDER, bag, file};
use libfuzzer_sys::fuzz_target;
use std::fs;

fuzz_target!(|bytes: &[u8]| {
    // What the database before left would be taken for a part of this one.
    for sidecar in ["bag.db3-wal", "bag.db3-shm", "bag.db3-journal"] {
        let _ = fs::remove_file(FOLDER.join(sidecar));
    }
    bag(&file("bag.db3", bytes));
});
