//! Flags of `eyebolt label`.

use crate::inputs::{BagArguments, CacheArguments, RobotArguments};
use eyebolt::dataset::Shard;
use std::path::PathBuf;

/// Options of `eyebolt label`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Recordings: folders with a recording.toml, or bags
    #[arg(required_unless_present = "merge")]
    pub recordings: Vec<PathBuf>,
    /// Folder of the data set; frames are added to those of a data set that is there
    #[arg(short, long, value_name = "FOLDER", required_unless_present = "merge")]
    pub output: Option<PathBuf>,
    /// Label by this calibration, of the same camera in the same place; otherwise each recording is
    /// calibrated from nothing, and not labelled if that is refused
    #[arg(long, value_name = "JSON")]
    pub calibration: Option<PathBuf>,
    /// Draw each frame that is labelled, with classes, box and keypoints, as PNG files in this folder
    #[arg(long, value_name = "FOLDER")]
    pub check: Option<PathBuf>,
    /// Replace pictures that exist; labelled frames are never replaced
    #[arg(long)]
    pub force: bool,
    /// Label only shard I of N, counted from 0, of the frames of all recordings: one for each machine
    #[arg(long, value_name = "I/N")]
    pub shard: Option<Shard>,
    /// Join the shards in this folder, if all of them are there, into one data set
    #[arg(
        long,
        value_name = "FOLDER",
        conflicts_with_all = ["recordings", "output", "calibration", "check", "shard"]
    )]
    pub merge: Option<PathBuf>,
    #[command(flatten)]
    pub robot: RobotArguments,
    /// Find the arm's pixels without the recordings' masks
    #[arg(long)]
    pub no_masks: bool,
    /// Seed of the search; the same seed gives the same bytes on any number of threads
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Threads to use; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Say what was labelled as JSON, a line for each recording
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub cache: CacheArguments,
    #[command(flatten)]
    pub bag: BagArguments,
}
