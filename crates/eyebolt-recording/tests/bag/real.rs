//! Bags of a real arm, where they are at hand, against the folder that they were made of.

use eyebolt_recording::{BagOptions, BagRecording, CameraInfo, FrameSource, Range};
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// Environment variable with the folder of shared data.
const SHARED: &str = "EYEBOLT_SHARED";

fn shared(test: &str) -> Option<PathBuf> {
    let Some(shared) = std::env::var_os(SHARED) else {
        // The harness would keep back what `eprintln!` says of a test that passes.
        let mut stderr = std::io::stderr();
        writeln!(stderr, "SKIPPED {test}: set {SHARED} to the shared data").unwrap();
        return None;
    };
    Some(PathBuf::from(shared).join("data/recordings"))
}

/// The numbers at the end of an NPY file, whose header is as long as it says.
fn npy<const N: usize, T>(path: &Path, number: impl Fn([u8; N]) -> T) -> Vec<T> {
    let bytes = std::fs::read(path).unwrap();
    let header = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    bytes[10 + header..].as_chunks::<N>().0.iter().map(|bytes| number(*bytes)).collect()
}

#[test]
fn lbr_med7_in_bags() {
    let Some(data) = shared("lbr_med7_in_bags") else { return };
    let folder = data.join("lbr_med7_zed2i");
    let camera = CameraInfo::read(&folder.join("left_camera_info.yaml")).unwrap();
    for name in ["ros2_mcap_zstd", "ros2_sqlite3"] {
        let path = data.join("lbr_med7_bags").join(name);
        let bag = BagRecording::open(&path, &BagOptions::default()).unwrap();
        assert_eq!(bag.frame_names(), ["0", "1", "2", "3", "4"], "{name}");
        assert_eq!(bag.camera(), Some(&camera.camera), "{name}");
        assert_eq!(bag.camera_frame_id(), camera.frame_id.as_deref());
        assert!(bag.robot().description.as_ref().unwrap().contains("<robot"));
        assert!(bag.topics().iter().all(|topic| topic.problems.is_empty()));
        for index in 0..5 {
            let frame = bag.read_frame(index).unwrap();
            let Range::Depth(depth) = &frame.range else { panic!("no depth") };
            let file = folder.join(format!("depth_{index}.npy"));
            let stored = npy(&file, f32::from_le_bytes);
            let same = stored
                .iter()
                .zip(depth.depth_m())
                .all(|(a, b)| a == b || (!a.is_finite() && *b == 0.0));
            assert!(same && stored.len() == depth.depth_m().len(), "{name}: {}", file.display());
            let joints = npy(&folder.join(format!("joint_states_{index}.npy")), f64::from_le_bytes);
            assert_eq!((joints.len(), frame.joints.len()), (7, 7));
            for (joint, position) in (1..).zip(joints) {
                let read = frame.joints.get(&format!("lbr_A{joint}")).unwrap();
                assert!((read - position).abs() < 1e-9, "{name}: frame {index}, joint {joint}");
            }
        }
    }
}
