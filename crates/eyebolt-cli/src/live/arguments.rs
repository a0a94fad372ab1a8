//! How `eyebolt live` is asked for.

use super::domain::DomainArguments;
use crate::calibrate::{LimitArguments, WayArguments};
use crate::inputs::{BagArguments, CacheArguments, RobotArguments};
use eyebolt_live::{Goal, WebAddress};
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
    /// Show the session on a page while it goes on, for browsers of this machine; 0.0.0.0:8642 is for whoever reaches it, such
    /// as a telephone [default: 127.0.0.1:8642]
    #[arg(long, value_name = "ADDRESS", num_args = 0..=1, default_missing_value = "127.0.0.1:8642")]
    pub web: Option<WebAddress>,
    /// Write a report for a browser at the end, as eyebolt calibrate does [default with --web: beside the calibration, .html]
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

impl Arguments {
    /// How what was recorded is calibrated, on the way and in the end.
    pub fn way(&self) -> WayArguments {
        WayArguments::plain(self.limits.clone(), self.seed, self.cache.clone())
    }

    /// Where the report goes, if there is to be one.
    pub fn report(&self) -> Option<PathBuf> {
        let beside = self.web.map(|_| self.output.with_extension("html"));
        self.report.clone().or(beside)
    }
}
