//! The description of a folder, `recording.toml`, with files that it may name.
#![no_main]

use eyebolt_fuzz::{file, recording};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    file("camera_info.yaml", include_bytes!("../seeds/camera_info/ros2.yaml"));
    file("depth_1.npy", include_bytes!("../seeds/npy/depth.npy"));
    file("depth_1.png", include_bytes!("../seeds/png_depth/depth.png"));
    file("cloud_1.npy", include_bytes!("../seeds/npy/cloud.npy"));
    file("cloud_1.pcd", include_bytes!("../seeds/pcd/grid_f4_binary.pcd"));
    file("color_1.png", include_bytes!("../seeds/png_depth/rgb.png"));
    file("mask_1.png", include_bytes!("../seeds/png_depth/mask.png"));
    file("background_1.npy", include_bytes!("../seeds/npy/depth.npy"));
    file("joints_1.npy", include_bytes!("../seeds/npy/joints.npy"));
    file("joints.csv", include_bytes!("../seeds/joints/table.csv"));
    recording(&file("recording.toml", bytes));
});
