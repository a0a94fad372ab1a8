//! The recording, with whatever a test changes about it.

use eyebolt::calibrate::Verdict;
use eyebolt::pipeline::{Outcome, Request, run};
use eyebolt::record::RecordOptions;
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_recording::{BagOptions, Recording};
use eyebolt_registration::LinkCache;
use eyebolt_robot::{Arm, PackageRoots, Robot};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Names of the arm's joints, in the order of the recorded values.
pub const JOINTS: [&str; 7] =
    ["lbr_A1", "lbr_A2", "lbr_A3", "lbr_A4", "lbr_A5", "lbr_A6", "lbr_A7"];

/// Frames of the recording.
pub const FRAMES: [usize; 5] = [0, 1, 2, 3, 4];

/// The shared data, or `None` said loudly.
pub fn shared() -> Option<PathBuf> {
    shared_with("data/recordings/lbr_med7_zed2i")
}

/// The shared data with this recording, or `None` said loudly.
pub fn shared_with(recording: &str) -> Option<PathBuf> {
    let folder = std::env::var_os("EYEBOLT_SHARED").map(PathBuf::from);
    let folder = folder.filter(|folder| folder.join(recording).is_dir());
    if folder.is_none() {
        // Past the test harness, which would keep it for itself.
        let remedy = "set EYEBOLT_SHARED to the folder of shared data";
        let _ = writeln!(std::io::stderr(), "SKIPPED a test on {recording}: {remedy}");
    }
    folder
}

/// One way to tell the recording.
pub struct Variant {
    /// Which of its frames, in which order; the same one may come again.
    pub frames: Vec<usize>,
    /// Names given to the recorded joint values.
    pub joints: Vec<String>,
    /// The robot, a path in the shared data, with its base and end-effector.
    pub robot: [&'static str; 3],
    /// Whether masks are used.
    pub masks: bool,
    /// Seed of the search.
    pub seed: u64,
}

impl Default for Variant {
    fn default() -> Self {
        Self {
            frames: FRAMES.to_vec(),
            joints: JOINTS.map(str::to_owned).to_vec(),
            robot: ["data/robots/lbr_med7/lbr_med7.urdf", "lbr_link_0", "lbr_link_7"],
            masks: true,
            seed: 1,
        }
    }
}

/// Everything a run needs, kept alive.
pub struct Opened {
    pub recording: Recording<'static>,
    arm: Arm,
    cache: LinkCache,
    masks: bool,
    seed: u64,
    _folder: tempfile::TempDir,
}

impl Variant {
    /// Writes the recording as a folder of links to the shared files.
    pub fn open(&self, shared: &Path) -> Opened {
        let folder = tempfile::tempdir().unwrap();
        let data = shared.join("data/recordings/lbr_med7_zed2i");
        for (index, frame) in self.frames.iter().enumerate() {
            let files = [
                (format!("depth_{frame}.npy"), format!("depth_{index}.npy")),
                (format!("joint_states_{frame}.npy"), format!("joint_states_{index}.npy")),
                (format!("mask_sam2_left_image_{frame}.png"), format!("mask_{index}.png")),
            ];
            for (from, to) in files {
                std::fs::copy(data.join(from), folder.path().join(to)).unwrap();
            }
        }
        let camera = format!("[camera]\ninfo = {:?}\n", data.join("left_camera_info.yaml"));
        let frames = "depth = \"depth_{}.npy\"\ndepth_unit = \"m\"\nmask = \"mask_{}.png\"\n";
        std::fs::write(folder.path().join("recording.toml"), self.manifest(&camera, frames))
            .unwrap();
        self.opened(shared, folder)
    }

    /// The text of a `recording.toml` with these lines for camera and range images.
    pub fn manifest(&self, camera: &str, frames: &str) -> String {
        format!(
            "{camera}[frames]\n{frames}joints = \"joint_states_{{}}.npy\"\njoint_names = {:?}\n",
            self.joints
        )
    }

    /// Opens a folder that has been written.
    pub fn opened(&self, shared: &Path, folder: tempfile::TempDir) -> Opened {
        let [urdf, base, end_effector] = self.robot;
        let robot = Robot::from_urdf_file(&shared.join(urdf), &PackageRoots::new()).unwrap();
        Opened {
            recording: Recording::open(folder.path(), &BagOptions::default()).unwrap(),
            arm: robot.arm(Some(base), Some(end_effector)).unwrap(),
            cache: LinkCache::new(std::env::temp_dir().join("eyebolt-test-links")),
            masks: self.masks,
            seed: self.seed,
            _folder: folder,
        }
    }
}

impl Opened {
    /// What the run is asked to do.
    pub fn request(&self) -> Request<'_> {
        Request {
            cache: self.cache.clone(),
            options: RecordOptions { use_masks: self.masks, ..RecordOptions::default() },
            seed: self.seed,
            ..Request::new(self.recording.source(), &self.arm)
        }
    }

    /// Runs it.
    pub fn run(&self) -> Outcome {
        run(&self.request(), &()).unwrap()
    }
}

/// The pose of a trusted outcome.
#[track_caller]
pub fn trusted(outcome: &Outcome) -> Transform<Camera, Base> {
    assert_eq!(outcome.calibration.verdict, Verdict::Trusted);
    outcome.calibration.camera_from_base.unwrap()
}
