//! What the fuzz targets share: files for the readers that open them by themselves, and a network
//! for weights.

use eyebolt_net::coordinates::{Kernel, KernelSpec};
use eyebolt_net::graph::{Domain, Graph, GraphBuilder, Source};
use eyebolt_recording::{BagOptions, Recording, WriteRobot, read_truth, write_mcap};
use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// A folder of this process alone. `fuzz/run` sets `TMPDIR` to one in memory and removes it.
pub static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = std::env::temp_dir().join(format!("eyebolt-fuzz-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("the temporary folder can be written to");
    folder
});

/// The file `name` with these bytes, overwritten by the next call.
pub fn file(name: &str, bytes: &[u8]) -> PathBuf {
    let path = FOLDER.join(name);
    fs::write(&path, bytes).expect("the temporary folder has room");
    path
}

/// Frames of a recording that are read.
const MOST_FRAMES: usize = 3;

/// Reads the recording at `path` and writes it again, if it is one.
pub fn recording(path: &Path) {
    let _ = read_truth(path);
    for partial in [false, true] {
        let options = BagOptions { partial, scratch: FOLDER.clone(), ..BagOptions::default() };
        let Ok(recording) = Recording::open(path, &options) else { continue };
        for index in 0..recording.frame_names().len().min(MOST_FRAMES) {
            let _ = (recording.read_frame(index), recording.read_color(index));
        }
        for index in 0..recording.background_count().min(MOST_FRAMES) {
            let _ = recording.read_background(index);
        }
        if let Some(bag) = recording.bag() {
            let _ = (bag.topics(), bag.dropped_frames(), bag.clock_offset(), bag.damage());
        }
        let mut written = Cursor::new(Vec::new());
        let robot = WriteRobot::default();
        let _ = write_mcap(&recording, &robot, &mut written, &());
    }
}

/// Reads the bag at `path`, message by message and as a recording.
pub fn bag(path: &Path) {
    eyebolt_recording::fuzzing::bag(path, &FOLDER);
    recording(path);
}

/// A network of a few values with a parameter of every kind.
pub fn network() -> Graph {
    let mut g = GraphBuilder::new();
    let x = g.input(Source::Features, Domain::Voxels { stride: 1 }, 1);
    let spec = KernelSpec { kernel: Kernel::new(3), from: 1, to: 1 };
    let x = g.convolution("convolution", x, spec, 1, true).expect("a convolution");
    let x = g.batch_norm("norm", x);
    let x = g.linear("linear", x, 1, true);
    g.finish(&[x]).expect("a network")
}
