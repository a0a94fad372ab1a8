//! `eyebolt simulate`.

pub mod flags;
mod lab_flags;
pub mod numbers;
mod recording;

pub use recording::{record, record_telling};

use crate::ending::Ending;
use crate::front::{Front, Terminal};
use crate::inputs::{CacheArguments, marker, use_threads};
use crate::output;
use crate::shell::quoted;
use anyhow::{Result, bail};
use eyebolt::simulate::{Plan, Scenario, plan};
use eyebolt_markers::Target;
use eyebolt_render::Sensor;
use flags::{CameraArguments, FaultArguments, RobotArguments};
use std::path::{Path, PathBuf};

/// Options of `eyebolt simulate`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    robot: RobotArguments,
    /// Depth camera
    #[arg(long, default_value = "kinect-v1", value_parser = flags::sensor())]
    sensor: Sensor,
    #[command(flatten)]
    camera: CameraArguments,
    /// How many configurations the arm rests in
    #[arg(long, value_name = "COUNT", default_value_t = 6, value_parser = clap::value_parser!(u16).range(1..=200))]
    configurations: u16,
    /// Frames of each configuration
    #[arg(long, value_name = "COUNT", default_value_t = 10, value_parser = clap::value_parser!(u16).range(1..=10_000))]
    frames: u16,
    /// Frames taken while the arm moves from one configuration to the next
    #[arg(long, value_name = "COUNT", default_value_t = 0, value_parser = clap::value_parser!(u16).range(0..=1000))]
    moving_frames: u16,
    /// Frames without the arm, taken before
    #[arg(long, value_name = "COUNT", default_value_t = 10, value_parser = clap::value_parser!(u16).range(0..=1000))]
    backgrounds: u16,
    /// Things that stand about: boxes, bottles, balls, cables, people
    #[arg(long, value_name = "COUNT", default_value_t = 8, value_parser = clap::value_parser!(u16).range(0..=50))]
    clutter: u16,
    /// Put a marker on the hand, on a plate that changes its shape, and take colour pictures: as of `eyebolt
    /// calibrate --marker`
    #[arg(long, value_name = "MARKER", value_parser = marker)]
    marker: Option<Target>,
    /// Seed of all random choices; the same seed gives the same bytes on any number of threads
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Where to write the recording, an MCAP file
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Replace an existing file
    #[arg(long)]
    force: bool,
    /// Threads to use; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(flatten)]
    cache: CacheArguments,
    // Last: its heading goes on to what follows.
    #[command(flatten)]
    faults: FaultArguments,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    destination(arguments)?;
    planned(arguments, &Terminal, |plan| record(plan, &arguments.output, arguments.force))?;
    output::say(&summary(arguments));
    Ok(Ending::Done)
}

/// Where the recording goes, checked before any work is done, and whether it replaces what is there.
pub(crate) fn destination(arguments: &Arguments) -> Result<(&Path, bool)> {
    let ending = arguments.output.extension().and_then(|ending| ending.to_str());
    if !ending.is_some_and(|ending| ending.eq_ignore_ascii_case("mcap")) {
        bail!(
            "{}: --output: the recording is MCAP. Name a file that ends in .mcap",
            arguments.output.display()
        );
    }
    output::refuse_existing(&arguments.output, arguments.force)?;
    Ok((&arguments.output, arguments.force))
}

/// What `then` makes of the plan that `arguments` ask for.
pub(crate) fn planned<T>(
    arguments: &Arguments,
    front: &dyn Front,
    then: impl FnOnce(&Plan<'_>) -> Result<T>,
) -> Result<T> {
    let robot = arguments.robot.read(front)?;
    let scenario = Scenario {
        arm: &robot.arm,
        urdf: &robot.urdf,
        sensor: arguments.sensor,
        viewpoint: arguments.camera.viewpoint(),
        configurations: usize::from(arguments.configurations),
        frames: usize::from(arguments.frames),
        moving_frames: usize::from(arguments.moving_frames),
        backgrounds: usize::from(arguments.backgrounds),
        clutter: usize::from(arguments.clutter),
        faults: arguments.faults.faults(),
        seed: arguments.seed,
    };
    let waiting = front.wait("choosing configurations");
    let plan = plan(scenario, &arguments.cache.open())?;
    let plan = match &arguments.marker {
        Some(target) => plan.with_marker(target),
        None => plan,
    };
    drop(waiting);
    then(&plan)
}

fn summary(arguments: &Arguments) -> String {
    let Arguments { configurations, frames, sensor, output, .. } = arguments;
    let path = quoted(&output.display().to_string());
    let robot = arguments.robot.to_calibrate();
    let marker = arguments.marker.as_ref().map(|target| format!(" --marker {target}"));
    let marker = marker.unwrap_or_default();
    format!(
        "{configurations} x {frames} frames by a simulated {sensor}, written to {}\n\ncalibrate it, and \
         see how far off that is:\n  eyebolt calibrate {path}{robot}{marker} -o calibration.json\n  eyebolt \
         evaluate {path} calibration.json",
        output.display()
    )
}
