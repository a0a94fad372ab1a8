//! Flags of `eyebolt batch`.

use crate::calibrate::WayArguments;
use crate::inputs::{BagArguments, RobotArguments};
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
    pub way: WayArguments,
    /// Threads to use; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    #[command(flatten)]
    pub bag: BagArguments,
}
