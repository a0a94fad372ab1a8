//! `eyebolt convert`.

use crate::ending::Ending;
use crate::inputs::{RecordingArguments, RobotArguments};
use crate::output;
use crate::progress::{Counting, Waiting};
use anyhow::{Context, Result, bail};
use eyebolt_recording::{Recording, write_folder, write_mcap};
use std::io::BufWriter;
use std::path::{Path, PathBuf};

/// Options of `eyebolt convert`.
///
/// A bag becomes an MCAP with the messages that a calibration needs: depth, intrinsics, joint states,
/// robot description, static transforms, and backgrounds, masks and colour where there are any. A folder holds the
/// frames at rest only.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    recording: RecordingArguments,
    /// What to write: a file that ends in .mcap, or a folder
    output: PathBuf,
    #[command(flatten)]
    robot: RobotArguments,
    /// Replace what exists
    #[arg(long)]
    force: bool,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    let output = &arguments.output;
    let kind = Kind::of(output)?;
    check(arguments, kind)?;
    let waiting = Waiting::new("reading the recording");
    let recording = arguments.recording.open_of(&arguments.robot)?;
    drop(waiting);
    let files = &recording.provenance().files;
    files.iter().try_for_each(|source| refuse_source(output, source))?;
    let robot = arguments.robot.to_write(&recording)?;
    let bar = Counting::new()?;
    match kind {
        Kind::Mcap => output::write_through(output, arguments.force, |file| {
            let writer = BufWriter::new(file);
            write_mcap(&recording, &robot, writer, &bar)
                .map_err(|error| output::named(error, output))
        })?,
        Kind::Folder => output::write_folder_whole(output, arguments.force, |folder| {
            write_folder(&recording, &robot, folder, &bar)
                .map_err(|error| output::named(error, output))
        })?,
    }
    drop(bar);
    output::say(&summary(&recording, kind, output, robot.urdf.is_some()));
    Ok(Ending::Done)
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Mcap,
    Folder,
}

impl Kind {
    fn of(output: &Path) -> Result<Self> {
        let ending = output.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        match ending.to_ascii_lowercase().as_str() {
            "mcap" => Ok(Self::Mcap),
            "bag" | "db3" | "zstd" | "zst" | "toml" => bail!(
                "{}: files in .{ending} are not written. Name one that ends in .mcap, or a folder",
                output.display()
            ),
            _ => Ok(Self::Folder),
        }
    }
}

/// Better told now than after the work.
fn check(arguments: &Arguments, kind: Kind) -> Result<()> {
    let output = &arguments.output;
    output::refuse_existing(output, arguments.force)?;
    refuse_source(output, &arguments.recording.recording)?;
    match kind {
        Kind::Mcap if output.is_dir() => {
            bail!("{}: this is a folder. Name a file in it", output.display())
        }
        Kind::Folder if output.exists() => check_replaceable(output),
        _ => Ok(()),
    }
}

/// With --force, a folder is replaced if there is nothing in it but a recording of ours.
fn check_replaceable(folder: &Path) -> Result<()> {
    let known = |name: &str| {
        let images = ["depth_", "cloud_", "mask_", "color_", "background_"];
        let image = images.iter().any(|prefix| name.starts_with(prefix));
        const OTHERS: [&str; 6] = [
            "recording.toml",
            "camera_info.yaml",
            "tf_static.yaml",
            "joints.csv",
            "robot.urdf",
            "truth.json",
        ];
        OTHERS.contains(&name) || (image && (name.ends_with(".png") || name.ends_with(".npy")))
    };
    let failed = || format!("{}: cannot be listed. Name another place", folder.display());
    for entry in std::fs::read_dir(folder).with_context(failed)? {
        let entry = entry.with_context(failed)?;
        let ours = entry.file_name().to_str().is_some_and(known) && entry.path().is_file();
        if !ours {
            bail!(
                "{}: {} is not of a recording that eyebolt wrote. Name another place",
                folder.display(),
                entry.file_name().display()
            );
        }
    }
    Ok(())
}

/// What is read must not be written over, nor what it lies in.
pub(crate) fn refuse_source(output: &Path, source: &Path) -> Result<()> {
    let Ok(real) = output.canonicalize() else { return Ok(()) };
    if source.canonicalize().is_ok_and(|source| source.starts_with(&real)) {
        bail!(
            "{}: this is the recording itself, or has it in it. Name another place",
            output.display()
        );
    }
    Ok(())
}

fn summary(recording: &Recording, kind: Kind, output: &Path, robot: bool) -> String {
    let count = recording.frame_names().len();
    let dropped = recording.provenance().dropped.len();
    let frames = match (kind, dropped) {
        (_, 0) => format!("{count} frames"),
        (Kind::Mcap, _) => format!("{} frames, {count} of them at rest", count + dropped),
        (Kind::Folder, _) => {
            format!("{count} frames at rest; {dropped} others are left out (see `eyebolt info`)")
        }
    };
    let mut text = format!("{frames}, written to {}", output.display());
    if robot {
        text += "\nmeshes are not part of it: give --package-path when reading it elsewhere";
    } else {
        text += "\nthere is no robot description in it: give --robot arm.urdf to add one";
    }
    text
}
