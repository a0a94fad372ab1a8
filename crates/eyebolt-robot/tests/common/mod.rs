//! Things that several tests need.
#![allow(dead_code, clippy::unwrap_used)]

use eyebolt_robot::{PackageRoots, Robot};
use std::io::Write;
use std::path::PathBuf;

pub fn fixture(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(name)
}

pub fn small_arm() -> Robot {
    Robot::from_urdf_file(&fixture("small_arm.urdf"), &PackageRoots::new()).unwrap()
}

pub fn parse(urdf: &str) -> Result<Robot, eyebolt_robot::RobotError> {
    Robot::from_urdf_str(urdf, None, &PackageRoots::new())
}

/// A file of the shared data; `None`, said aloud, where there is none.
pub fn shared(path: &str) -> Option<PathBuf> {
    let Some(root) = std::env::var_os("EYEBOLT_SHARED") else {
        // Straight to the terminal: the test harness hides what passing tests print.
        let remedy = "set EYEBOLT_SHARED to the folder that holds data/robots";
        let _ = writeln!(std::io::stderr(), "SKIPPED: needs {path}; {remedy}");
        return None;
    };
    let path = PathBuf::from(root).join(path);
    assert!(path.exists(), "{} does not exist", path.display());
    Some(path)
}

pub fn panda() -> Option<Robot> {
    shared_robot("data/robots/panda/panda_hand.urdf")
}

pub fn lbr() -> Option<Robot> {
    shared_robot("data/robots/lbr_med7/lbr_med7.urdf")
}

fn shared_robot(path: &str) -> Option<Robot> {
    Some(Robot::from_urdf_file(&shared(path)?, &PackageRoots::new()).unwrap())
}
