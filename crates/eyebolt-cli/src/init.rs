//! `eyebolt init`.

use crate::ending::Ending;
use crate::output;
use crate::shell::quoted;
use anyhow::Result;
use eyebolt_recording::{Described, Folder, describe_folder, description_of};
use eyebolt_robot::{PackageRoots, Robot};
use std::path::{Path, PathBuf};

/// Options of `eyebolt init`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Folder with the files of a recording
    folder: PathBuf,
    /// Print the recording.toml instead of writing it
    #[arg(long)]
    print: bool,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    let Described { toml, to_check } = describe_folder(&arguments.folder, &joint_names)?;
    if arguments.print {
        output::deliver(toml.as_bytes())?;
        return Ok(Ending::Done);
    }
    let path = description_of(&arguments.folder);
    output::write_whole(&path, toml.as_bytes(), false)?;
    let checks: String = to_check.iter().map(|check| format!("\n- {check}")).collect();
    let folder = quoted(&arguments.folder.display().to_string());
    let next = match Folder::open(&arguments.folder) {
        Ok(_) => format!("then: eyebolt info {folder}"),
        Err(error) => format!("it cannot be read yet: {error}"),
    };
    output::say(&format!("written to {}{checks}\n\n{next}", path.display()));
    Ok(Ending::Done)
}

/// Names of the joints that move, in the order of the robot description at `urdf`; none if it cannot
/// be read.
fn joint_names(urdf: &Path) -> Vec<String> {
    let Ok(robot) = Robot::from_urdf_file(urdf, &PackageRoots::new()) else { return Vec::new() };
    let moving = robot.joints.iter().filter(|joint| joint.moves() && joint.mimic.is_none());
    moving.map(|joint| joint.name.clone()).collect()
}
