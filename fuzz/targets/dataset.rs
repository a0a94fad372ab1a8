//! Frames of data sets: NPZ archives, and what is in them.
#![no_main]

use eyebolt::dataset::Dataset;
use eyebolt_fuzz::{FOLDER, file};
use libfuzzer_sys::fuzz_target;

const DESCRIPTION: &str = include_str!("../seeds/dataset/dataset.toml");

fuzz_target!(|bytes: &[u8]| {
    file("dataset.toml", DESCRIPTION.as_bytes());
    file("frame.npz", bytes);
    let line = format!(
        r#"{{"recording":"a","number":0,"frame":"0","file":"frame.npz","bytes":{},"pixels":{{"background":0,"arm":0,"end_effector":0,"ignore":0,"no_depth":0}},"keypoints_seen":[]}}"#,
        bytes.len()
    );
    file("index.jsonl", line.as_bytes());
    let dataset = Dataset::open(&FOLDER).expect("description and index are good");
    if let Ok(frame) = dataset.read(&dataset.frames()[0]) {
        assert_eq!(frame.labels.len(), frame.depth.depth_m().len());
        assert_eq!(frame.keypoints.len(), frame.labels.len());
    }
});
