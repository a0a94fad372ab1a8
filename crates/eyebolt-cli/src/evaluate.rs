//! `eyebolt evaluate`.

mod calibration;
mod models;

use crate::ending::Ending;
use crate::inputs::{CacheArguments, RobotArguments, marker, use_threads};
use anyhow::{Result, bail};
use eyebolt_markers::Target;
use std::path::PathBuf;

/// Options of `eyebolt evaluate`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// A recording that eyebolt simulate made (or its truth.json) and a calibration made from it; with --model,
    /// recordings
    #[arg(required = true, value_name = "RECORDING CALIBRATION | RECORDING")]
    paths: Vec<PathBuf>,
    /// Folder of a model: prints the tables of the paper for labels, poses and calibrations that its networks make of
    /// the recordings. Given several times, also how each does on each recording
    #[arg(long, value_name = "[NAME=]FOLDER")]
    model: Vec<String>,
    /// With --model: what to take for the truth of recordings that have none, one for each of them in their order
    #[arg(long, value_name = "CALIBRATION", requires = "model")]
    calibration: Vec<PathBuf>,
    /// With --model: also calibrate by this marker the recordings of --marked, as calibrate --marker does
    #[arg(long, value_name = "MARKER", value_parser = marker, requires_all = ["model", "marked"])]
    marker: Option<Target>,
    /// Recording with a marker on the hand, which changes its shape: of the same poses, made apart. May be repeated
    #[arg(long, value_name = "RECORDING", requires = "marker")]
    marked: Vec<PathBuf>,
    #[command(flatten)]
    robot: RobotArguments,
    /// JSON instead of text
    #[arg(long)]
    json: bool,
    /// With --model: write the figures to this file, a line each
    #[arg(long, value_name = "FILE", requires = "model")]
    csv: Option<PathBuf>,
    /// With --model: write the tables as a page for a browser
    #[arg(long, value_name = "HTML", requires = "model")]
    report: Option<PathBuf>,
    /// Replace existing files
    #[arg(long)]
    force: bool,
    /// Threads to use; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(flatten)]
    cache: CacheArguments,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    if !arguments.model.is_empty() {
        return models::run(&models::Wanted {
            recordings: &arguments.paths,
            models: &arguments.model,
            calibrations: &arguments.calibration,
            marker: arguments.marker.as_ref(),
            marked: &arguments.marked,
            robot: &arguments.robot,
            json: arguments.json,
            csv: arguments.csv.as_deref(),
            report: arguments.report.as_deref(),
            force: arguments.force,
            cache: &arguments.cache,
        });
    }
    match arguments.paths.as_slice() {
        [session, calibration] => calibration::run(session, calibration, arguments.json),
        other => bail!(
            "{} were given where a recording and its calibration belong. Name both, or a model with --model to \
             evaluate on recordings",
            match other.len() {
                1 => "one path".to_owned(),
                count => format!("{count} paths"),
            }
        ),
    }
}
