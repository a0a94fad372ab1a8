//! A recording of a real arm, where it is at hand.

use eyebolt_recording::{Folder, FrameSource, Range};
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::PathBuf;
use std::time::Instant;

/// Environment variable with the folder of shared data.
const SHARED: &str = "EYEBOLT_SHARED";

fn manifest(data: &str) -> String {
    let mut text = format!("[camera]\ninfo = '{data}/left_camera_info.yaml'\n[frames]\n");
    for (key, pattern) in [
        ("depth", "depth_{}.npy"),
        ("color", "left_image_{}.png"),
        ("mask", "mask_sam2_left_image_{}.png"),
        ("joints", "joint_states_{}.npy"),
    ] {
        writeln!(text, "{key} = '{data}/{pattern}'").unwrap();
    }
    let names: Vec<_> = (1..=7).map(|i| format!("\"lbr_A{i}\"")).collect();
    writeln!(text, "depth_unit = \"m\"\njoint_names = [{}]", names.join(", ")).unwrap();
    text + "[robot]\nbase = \"lbr_link_0\"\nend_effector = \"lbr_link_7\"\n"
}

#[test]
fn lbr_med7_with_zed2i() {
    // The harness would keep back what `eprintln!` says of a test that passes.
    let mut stderr = std::io::stderr();
    let Some(shared) = std::env::var_os(SHARED) else {
        writeln!(stderr, "SKIPPED lbr_med7_with_zed2i: set {SHARED} to the shared data").unwrap();
        return;
    };
    let data = PathBuf::from(shared).join("data/recordings/lbr_med7_zed2i");
    let folder = tempfile::tempdir().unwrap();
    let text = manifest(data.to_str().unwrap());
    std::fs::write(folder.path().join("recording.toml"), text).unwrap();

    let recording = Folder::open(folder.path()).unwrap();
    assert_eq!(recording.frame_names(), ["0", "1", "2", "3", "4"]);
    assert_eq!(recording.camera_frame_id(), Some("zed_left_camera_optical_frame"));
    let camera = recording.camera().unwrap();
    assert_eq!((camera.width(), camera.height()), (960, 540));
    let start = Instant::now();
    for index in 0..5 {
        let frame = recording.read_frame(index).unwrap();
        let Range::Depth(depth) = &frame.range else { panic!("no depth") };
        assert!(depth.share_valid() > 0.5);
        assert!((10_000..200_000).contains(&frame.mask.unwrap().count()));
        assert_eq!(frame.joints.len(), 7);
        assert!(frame.joints.get("lbr_A7").is_some());
    }
    let per_frame_ms = start.elapsed().as_secs_f64() * 1e3 / 5.0;
    writeln!(stderr, "lbr_med7_with_zed2i: {per_frame_ms:.1} ms per frame").unwrap();
    assert_eq!(recording.read_color(4).unwrap().unwrap().rgb.len(), 960 * 540);
}
