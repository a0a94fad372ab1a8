//! Flags of `eyebolt batch`.

use crate::calibrate::LimitArguments;
use crate::calibrate::learned::LearnedArguments;
use crate::inputs::{BagArguments, CacheArguments, RobotArguments};
use eyebolt::dataset::Shard;
use std::path::PathBuf;

/// Options of `eyebolt batch`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Recordings: folders with a recording.toml, or bags
    #[arg(required_unless_present_any = ["list", "merge"])]
    pub recordings: Vec<PathBuf>,
    /// File with the path of a recording on each line, as seen from here; - reads standard input
    #[arg(long, value_name = "FILE")]
    pub list: Option<PathBuf>,
    /// Folder for calibrations, lines, table and page; a batch that is there is gone on with
    #[arg(short, long, value_name = "FOLDER", required_unless_present = "merge")]
    pub output: Option<PathBuf>,
    /// Calibrate only shard I of N, counted from 0, of the recordings: one for each machine, all with the same recordings
    /// and folder
    #[arg(long, value_name = "I/N")]
    pub shard: Option<Shard>,
    /// Calibrate nothing: sum up what shards left in this folder, if every recording has its line. The shard that ends last
    /// does so by itself
    #[arg(
        long,
        value_name = "FOLDER",
        conflicts_with_all = ["recordings", "list", "output", "shard", "retry", "json"]
    )]
    pub merge: Option<PathBuf>,
    /// Try those again that failed, such as when a disk was away
    #[arg(long)]
    pub retry: bool,
    /// Write a page for a browser beside each calibration
    #[arg(long)]
    pub report: bool,
    /// Say the line of each recording as JSON, also of those that were done before, and nothing else
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub robot: RobotArguments,
    #[command(flatten)]
    pub learned: LearnedArguments,
    /// Find the arm's pixels by what moved, even if the recordings have masks
    #[arg(long)]
    pub no_masks: bool,
    /// Of more configurations, use those that differ most
    #[arg(long, value_name = "COUNT", default_value_t = 30, value_parser = clap::value_parser!(u16).range(3..))]
    pub max_configurations: u16,
    #[command(flatten)]
    pub limits: LimitArguments,
    /// Seed of the search; the same seed gives the same bytes on any number of threads and shards
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Threads to use; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    #[command(flatten)]
    pub cache: CacheArguments,
    #[command(flatten)]
    pub bag: BagArguments,
}
