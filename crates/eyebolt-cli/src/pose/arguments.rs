//! Flags of `eyebolt pose`.

use crate::inputs::{CacheArguments, RecordingArguments, RobotArguments, model_files};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use eyebolt::model_files::ModelFiles;
use eyebolt::pose::PoseMethod;
use std::path::PathBuf;

/// Options of `eyebolt pose`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    pub(super) recording: RecordingArguments,
    #[command(flatten)]
    pub(super) robot: RobotArguments,
    /// Model that eyebolt train made for this end-effector: its folder, or one that comes with the program (panda,
    /// shackle)
    #[arg(long, value_name = "MODEL", value_parser = model_files())]
    pub(super) model: ModelFiles,
    /// How the pose comes about: by rotation and translation, by matched points, or by both and what the
    /// image supports
    #[arg(long, default_value = "fused", value_parser = method())]
    pub(super) method: PoseMethod,
    /// Leave the pose as the networks have it
    #[arg(long)]
    pub(super) no_icp: bool,
    /// Take the positions of fingers from the recording's joint states; otherwise the likeliest
    /// opening is found
    #[arg(long)]
    pub(super) joint_states: bool,
    /// Go on with frames as they come into an MCAP that is still being written, until it ends or Ctrl-C; so it is, too,
    /// where RECORDING is -, an MCAP by standard input
    #[arg(long)]
    pub(super) follow: bool,
    /// A line of JSON for each frame instead of text
    #[arg(long)]
    pub(super) json: bool,
    /// Write the lines of JSON to this file, too; if it ends in .mcap, the poses as messages for Foxglove and RViz
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// Replace an existing file
    #[arg(long)]
    pub(super) force: bool,
    /// Threads to use; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,
    #[command(flatten)]
    pub(super) cache: CacheArguments,
}

fn method() -> impl TypedValueParser<Value = PoseMethod> {
    PossibleValuesParser::new(PoseMethod::ALL.map(|(name, _)| name)).try_map(|name| {
        let known = PoseMethod::ALL.into_iter().find(|(known, _)| *known == name);
        known.map(|(_, method)| method).ok_or("not a method")
    })
}
