//! How `eyebolt live` is asked for.

use super::domain::DomainArguments;
use crate::calibrate::LimitArguments;
use crate::inputs::{BagArguments, CacheArguments, RobotArguments};
use eyebolt_live::Goal;
use std::path::PathBuf;

/// Options of `eyebolt live`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    pub domain: DomainArguments,
    /// Where to write the calibration; a refused one goes to *.rejected.json beside it
    #[arg(short, long, default_value = "calibration.json")]
    pub output: PathBuf,
    /// Where what comes in is recorded, for eyebolt calibrate and everybody else [default: session.mcap beside the
    /// calibration]
    #[arg(long, value_name = "MCAP")]
    pub session: Option<PathBuf>,
    /// The expected error with which the session ends by itself
    #[arg(long, value_name = "MM,DEG", default_value_t)]
    pub goal: Goal,
    /// Write a page for a browser at the end, as eyebolt calibrate does
    #[arg(long, value_name = "HTML")]
    pub report: Option<PathBuf>,
    /// End when the calibration is written; otherwise it is published on /tf_static until you end it
    #[arg(long)]
    pub no_tf: bool,
    /// Replace existing files
    #[arg(long)]
    pub force: bool,
    /// Seed of the search
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    #[command(flatten)]
    pub bag: BagArguments,
    #[command(flatten)]
    pub robot: RobotArguments,
    #[command(flatten)]
    pub limits: LimitArguments,
    #[command(flatten)]
    pub cache: CacheArguments,
}
