//! `eyebolt evaluate`.

mod calibration;
mod models;

use crate::ending::Ending;
use crate::front::{Front, Terminal};
use crate::inputs::{CacheArguments, RobotArguments, marker, use_threads};
use anyhow::{Result, bail};
use eyebolt::export::SavedCalibration;
use eyebolt_markers::Target;
use std::path::PathBuf;

/// Options of `eyebolt evaluate`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// A recording that eyebolt simulate made (or its truth.json) and a calibration made from it; with --model,
    /// recordings
    #[arg(required = true, value_name = "RECORDING CALIBRATION | RECORDING")]
    paths: Vec<PathBuf>,
    /// Model, its folder or one that comes with the program: prints the tables of the paper for labels, poses and
    /// calibrations that its networks make of the recordings. Given several times, also how each does on each recording
    #[arg(long, value_name = "[NAME=]MODEL")]
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

impl Arguments {
    fn wanted(&self) -> models::Wanted<'_> {
        models::Wanted {
            recordings: &self.paths,
            models: &self.model,
            calibrations: &self.calibration,
            marker: self.marker.as_ref(),
            marked: &self.marked,
            robot: &self.robot,
            json: self.json,
            csv: self.csv.as_deref(),
            report: self.report.as_deref(),
            force: self.force,
            cache: &self.cache,
        }
    }
}

/// The tables, or of a calibration (name and text) of the one recording that `arguments` name how far off it is: JSON.
pub(crate) fn json(
    arguments: &Arguments,
    calibration: Option<(&str, &str)>,
    front: &dyn Front,
) -> Result<String> {
    match (calibration, arguments.paths.as_slice()) {
        (Some((name, text)), [session]) => {
            let calibration = SavedCalibration::parse(name, text)?;
            Ok(serde_json::to_string(&calibration::of(session, name, &calibration)?)?)
        }
        (None, _) if !arguments.model.is_empty() => models::json(&arguments.wanted(), front),
        _ => bail!("name a recording with its calibration, or recordings with --model"),
    }
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    if !arguments.model.is_empty() {
        return models::run(&arguments.wanted(), &Terminal);
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
