//! `eyebolt train`.

mod folder;
mod lessons;

use crate::ending::Ending;
use crate::inputs::{CacheArguments, use_threads};
use crate::output;
use crate::progress::Counting;
use crate::shell::quoted;
use crate::simulate::flags::RobotArguments;
use anyhow::Result;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use eyebolt::train::Preset;
use lessons::Kind;
use std::path::PathBuf;

/// Options of `eyebolt train`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// What to teach
    #[arg(value_enum, default_value = "all")]
    what: What,
    #[command(flatten)]
    robot: RobotArguments,
    /// Teach to tell any arm from the rest, on arms that are made up, instead of knowing one
    #[arg(long, conflicts_with = "robot")]
    any_arm: bool,
    /// Minutes for each network: as many steps as fit
    #[arg(long, default_value_t = 30.0, value_parser = crate::inputs::positive, conflicts_with = "steps")]
    minutes: f64,
    /// Steps for each network, instead of minutes: the same steps give the same bytes
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..=100_000_000))]
    steps: Option<u64>,
    /// Which networks: those on images, the paper's, or small ones on voxels
    #[arg(long, default_value = "default", value_parser = preset())]
    preset: Preset,
    /// Seed of all random choices
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Folder of the model; begun networks in it are gone on with, ready ones are left as they are
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    /// Begin anew, whatever is there
    #[arg(long)]
    force: bool,
    /// Threads to use; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(flatten)]
    cache: CacheArguments,
}

/// What to teach.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum What {
    /// Which pixels are the arm, and which the end-effector
    Segmentation,
    /// How the end-effector is turned
    Rotation,
    /// Where keypoints of the end-effector are
    Keypoints,
    /// All three; with --any-arm the segmentation
    All,
}

fn preset() -> impl TypedValueParser<Value = Preset> {
    PossibleValuesParser::new(Preset::NAMES)
        .try_map(|name| Preset::named(&name).ok_or("not a preset"))
}

impl What {
    fn kinds(self, any_arm: bool) -> Result<&'static [Kind]> {
        Ok(match self {
            Self::Segmentation => &[Kind::Segmentation],
            Self::All if any_arm => &[Kind::Segmentation],
            _ if any_arm => anyhow::bail!(
                "--any-arm: an end-effector that nobody knows has neither a rotation nor keypoints. Teach \
                 the segmentation, or name a robot"
            ),
            Self::Rotation => &[Kind::Rotation],
            Self::Keypoints => &[Kind::Keypoints],
            Self::All => &[Kind::Segmentation, Kind::Rotation, Kind::Keypoints],
        })
    }
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    let kinds = arguments.what.kinds(arguments.any_arm)?;
    let bar = Counting::new()?;
    for kind in kinds {
        lessons::teach(arguments, *kind, &bar)?;
    }
    drop(bar);
    let path = quoted(&arguments.output.display().to_string());
    output::say(&format!("\nuse it:\n  eyebolt segment RECORDING --model {path} -o labels/"));
    Ok(Ending::Done)
}
