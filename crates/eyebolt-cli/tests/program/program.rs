//! Runs of the program.

use crate::desk::{Desk, fresh, text};
use crate::recording::{write, write_depth};
use crate::scene::shots;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

/// A recording that is trusted, shared by all tests.
pub static RECORDING: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = fresh("program-recording");
    write_depth(&folder, &shots());
    write(&folder, "other.urdf", OTHER_URDF.as_bytes());
    folder
});

/// Shapes of links, shared by all tests.
pub static CACHE: LazyLock<PathBuf> = LazyLock::new(|| fresh("program-cache"));

/// A robot none of whose joints the recording has.
const OTHER_URDF: &str = r#"<robot name="stranger">
  <link name="foot"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
  <link name="head"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
  <joint name="neck" type="revolute">
    <parent link="foot"/><child link="head"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>"#;

/// What a run left behind.
pub struct Ended {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

impl Ended {
    /// Checks that it ended with `code`, and that all of `words` are in what it complained.
    #[track_caller]
    pub fn assert_error(&self, code: i32, words: &[&str]) {
        assert_eq!(self.code, Some(code), "out: {}\nerr: {}", self.out, self.err);
        assert_eq!(self.out, "", "nothing but the summary goes to standard output");
        for word in words {
            assert!(self.err.contains(word), "no {word:?} in: {}", self.err);
        }
    }
}

/// Runs `eyebolt` with these arguments.
pub fn eyebolt(arguments: &[&str]) -> Ended {
    eyebolt_in(Path::new("."), arguments)
}

/// As [`eyebolt`], in another folder.
pub fn eyebolt_in(folder: &Path, arguments: &[&str]) -> Ended {
    let mut command = Command::new(env!("CARGO_BIN_EXE_eyebolt"));
    // Other robots of whoever runs the tests are none of our business.
    command.env_remove("ROS_PACKAGE_PATH").env_remove("AMENT_PREFIX_PATH");
    let output = command.current_dir(folder).args(arguments).output().unwrap();
    Ended {
        code: output.status.code(),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

/// Runs `eyebolt calibrate` on `recording`, to be written to `output`.
pub fn calibrate(recording: &Path, output: &Path, more: &[&str]) -> Ended {
    let cache = text(&CACHE);
    let mut arguments =
        vec!["calibrate", text(recording), "--output", text(output), "--cache", cache];
    arguments.extend(more);
    eyebolt(&arguments)
}

impl Desk {
    /// Runs `eyebolt calibrate` on the shared recording into `calibration.json` in this folder.
    pub fn calibrate(&self, more: &[&str]) -> Ended {
        calibrate(&RECORDING, &self.file("calibration.json"), more)
    }

    /// As [`Self::calibrate`] with a robot that is not in the recording: refused in no time.
    pub fn calibrate_stranger(&self, more: &[&str]) -> Ended {
        let urdf = RECORDING.join("other.urdf");
        let mut arguments = vec!["--robot", text(&urdf)];
        arguments.extend(more);
        self.calibrate(&arguments)
    }
}
