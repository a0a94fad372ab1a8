//! `simulate` as a function.

use super::caller::Caller;
use super::error::CallError;
use super::options::{other, parsed};
use crate::arguments::Command;
use crate::simulate::{self as command, record_telling};
use eyebolt::progress::Progress;
use eyebolt::robots::BUILT_IN;
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_recording::InMemory;
use std::collections::BTreeMap;
use std::ffi::OsString;

/// A simulated recording in memory, with its truth.
pub struct Simulated {
    /// What was recorded: the frames at rest.
    pub frames: InMemory,
    /// Where the camera really is.
    pub camera_from_base: Transform<Camera, Base>,
    /// Where it is after it was bumped, if it is.
    pub camera_from_base_after: Option<Transform<Camera, Base>>,
    /// What has to be added to each joint that says otherwise than it stands, radians.
    pub joint_offsets: Vec<(String, f64)>,
}

/// Name and description of each robot that comes with the program.
#[must_use]
pub fn robots() -> BTreeMap<&'static str, String> {
    BUILT_IN.iter().map(|robot| (robot.name, robot.about().description)).collect()
}

/// Simulates what `words` ask for, as `eyebolt simulate` does, into memory.
///
/// # Errors
///
/// Words that are none of its options; a robot that cannot be read; a camera that hardly sees the end-effector; work that
/// was ended.
pub fn simulate(mut words: Vec<OsString>, caller: &Caller<'_>) -> Result<Simulated, CallError> {
    // The command writes a file; nothing is written here.
    words.insert(0, "--output=memory.mcap".into());
    let Command::Simulate(arguments) = parsed("simulate", words)? else { return other() };
    Ok(command::planned(&arguments, caller, |plan| {
        Ok(Simulated {
            frames: plan.in_memory()?,
            camera_from_base: plan.sought_camera_from_base(),
            camera_from_base_after: plan.sought_camera_from_base_after(),
            joint_offsets: plan.joint_offsets().into_iter().collect(),
        })
    })?)
}

/// Simulates what `words` ask for, as `eyebolt simulate` does, into the MCAP file that they name.
///
/// # Errors
///
/// As of [`simulate`]; also a file that exists, or cannot be written.
pub fn record_simulation(
    words: Vec<OsString>,
    caller: &Caller<'_>,
    progress: &dyn Progress,
) -> Result<(), CallError> {
    let Command::Simulate(arguments) = parsed("simulate", words)? else { return other() };
    let (output, force) = command::destination(&arguments)?;
    Ok(command::planned(&arguments, caller, |plan| record_telling(plan, output, force, progress))?)
}
