//! Simulations for tests.

use eyebolt::pipeline::Request;
use eyebolt::robots::BuiltIn;
use eyebolt::simulate::{Faults, Plan, Preset, Scenario, Viewpoint, plan};
use eyebolt_geometry::{Base, Camera, CoordinateFrame, DepthImage, Transform};
use eyebolt_recording::{BagOptions, Range, Recording, Truth, read_truth};
use eyebolt_registration::LinkCache;
use eyebolt_render::{Mode, Sensor};
use eyebolt_robot::{Arm, JointPositions};
use std::io::Cursor;
use std::path::PathBuf;
use std::sync::LazyLock;
use tempfile::TempDir;

/// A small image of a perfect camera: for what does not depend on the number of pixels.
pub const SENSOR: Sensor =
    Sensor { mode: Mode { width: 320, height: 240, focal_px: 262.5 }, ..Sensor::IDEAL };

pub static ARM: LazyLock<Arm> = LazyLock::new(|| shackle().arm());

/// Made anew for each run of the tests, once for all of them: what another version left there proves
/// nothing.
pub static CACHE: LazyLock<LinkCache> = LazyLock::new(|| {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("simulate-cache");
    let _ = std::fs::remove_dir_all(&folder);
    let cache = LinkCache::new(folder);
    plan(Scenario { configurations: 1, ..small() }, &cache).map(drop).unwrap();
    cache
});

pub fn shackle() -> &'static BuiltIn {
    BuiltIn::named("shackle").unwrap()
}

pub fn preset(name: &str) -> Viewpoint {
    Viewpoint::Preset(Preset::named(name).unwrap())
}

/// Two configurations of two frames, seen without error, and nothing around but the room.
pub fn small() -> Scenario<'static> {
    Scenario {
        arm: &ARM,
        urdf: shackle().urdf,
        sensor: SENSOR,
        viewpoint: preset("paper-test-p1"),
        configurations: 2,
        frames: 2,
        moving_frames: 0,
        backgrounds: 0,
        clutter: 0,
        faults: Faults::default(),
        seed: 7,
    }
}

pub fn planned(scenario: Scenario<'static>) -> Plan<'static> {
    plan(scenario, &CACHE).unwrap()
}

/// The bytes of its recording.
pub fn bytes(plan: &Plan<'_>) -> Vec<u8> {
    let mut output = Cursor::new(Vec::new());
    plan.record(&mut output, &()).unwrap();
    output.into_inner()
}

/// A recording, as its readers see it.
pub struct Recorded {
    pub recording: Recording<'static>,
    pub truth: Truth,
    _folder: TempDir,
}

impl Recorded {
    pub fn of(scenario: Scenario<'static>) -> Self {
        Self::of_plan(&planned(scenario))
    }

    pub fn of_plan(plan: &Plan<'_>) -> Self {
        Self::of_bytes(&bytes(plan))
    }

    pub fn of_bytes(bytes: &[u8]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("session.mcap");
        std::fs::write(&path, bytes).unwrap();
        let recording = Recording::open(&path, &BagOptions::default()).unwrap();
        Self { recording, truth: read_truth(&path).unwrap(), _folder: folder }
    }

    /// How it is calibrated, as a user would.
    pub fn request(&self) -> Request<'_> {
        Request { cache: CACHE.clone(), ..Request::new(self.recording.source(), &ARM) }
    }

    pub fn count(&self) -> usize {
        self.recording.frame_names().len()
    }

    pub fn joints(&self) -> Vec<JointPositions> {
        (0..self.count()).map(|frame| self.recording.read_joints(frame).unwrap()).collect()
    }

    pub fn depth(&self, frame: usize) -> DepthImage {
        let Range::Depth(depth) = self.recording.read_frame(frame).unwrap().range else {
            panic!("depth is recorded as images")
        };
        depth
    }

    /// Where the camera really was in `frame`.
    pub fn base_from_camera(&self, frame: usize) -> Transform<Base, Camera> {
        let stamp_ns = self.recording.stamp_ns(frame);
        self.truth.camera_from_base_at(stamp_ns).inverse()
    }
}

/// The greatest difference between two of the same joints, radians or metres.
pub fn apart(a: &JointPositions, b: &JointPositions) -> f64 {
    assert!(a.iter().map(|(name, _)| name).eq(b.iter().map(|(name, _)| name)));
    a.iter().zip(b.iter()).map(|((_, a), (_, b))| (a - b).abs()).fold(0.0, f64::max)
}

/// Readers keep the path of the joints as a broken line, within 0.2 mrad of what was said.
pub const AS_SAID: f64 = 2.1e-4;

/// Checks that two poses are the same but for the last digits, which another spelling costs.
#[track_caller]
pub fn assert_same<To: CoordinateFrame, From: CoordinateFrame>(
    a: &Transform<To, From>,
    b: &Transform<To, From>,
) {
    let apart = (a.matrix() - b.matrix()).amax();
    assert!(apart < 1e-12, "{apart}: {a:?} {b:?}");
}
