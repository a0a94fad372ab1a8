//! What `eyebolt train` is asked for.

use crate::inputs::{CacheArguments, model_files, positive};
use crate::simulate::flags::RobotArguments;
use crate::simulate::numbers;
use anyhow::{Result, bail};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use eyebolt::model_files::ModelFiles;
use eyebolt::train::Preset;
use std::path::PathBuf;

/// What a network tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Segmentation,
    EndEffector,
    Rotation,
    Keypoints,
}

impl Kind {
    /// Its folder in that of the model.
    pub fn name(self) -> &'static str {
        match self {
            Self::Segmentation => "segmentation",
            Self::EndEffector => "end_effector",
            Self::Rotation => "rotation",
            Self::Keypoints => "keypoints",
        }
    }
}

/// Options of `eyebolt train`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// What to teach
    #[arg(value_enum, default_value = "all")]
    what: What,
    #[command(flatten)]
    pub robot: RobotArguments,
    /// Teach to tell any arm from the rest, on arms that are made up, instead of knowing one
    #[arg(long, conflicts_with = "robot")]
    pub any_arm: bool,
    /// A data set of eyebolt label to learn from, of this robot; may be repeated
    #[arg(long, value_name = "FOLDER", conflicts_with = "any_arm")]
    pub data: Vec<PathBuf>,
    /// Share of the steps with simulated images, 0 to 1 [default: 1, or 0.5 with --data]
    #[arg(long, value_name = "SHARE", value_parser = numbers::number(0.0, 1.0), requires = "data")]
    pub simulated: Option<f64>,
    /// With --any-arm: a URDF of a real arm to know too, besides those that come with the program; may be
    /// repeated
    #[arg(long, value_name = "URDF", requires = "any_arm")]
    pub also: Vec<PathBuf>,
    /// Minutes for each network: as many steps as fit
    #[arg(long, default_value_t = 30.0, value_parser = positive, conflicts_with = "steps")]
    pub minutes: f64,
    /// Steps for each network, instead of minutes: the same steps give the same bytes
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..=100_000_000))]
    pub steps: Option<u64>,
    /// Which networks: those on images, the paper's, or small ones on voxels
    #[arg(long, default_value = "default", value_parser = preset())]
    pub preset: Preset,
    /// Seed of all random choices
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Begin with the weights of another model, as far as they fit [default: of one robot any-arm, which comes with the
    /// program and knows what arms look like, as far as it has a network of the kind]
    #[arg(long, value_name = "MODEL", value_parser = model_files())]
    from: Option<ModelFiles>,
    /// Begin with weights that are drawn at random
    #[arg(long, conflicts_with = "from")]
    from_nothing: bool,
    /// Folder of the model; begun networks in it are gone on with, ready ones are left as they are
    #[arg(short, long, value_name = "FOLDER")]
    pub output: PathBuf,
    /// Begin anew, whatever is there
    #[arg(long)]
    pub force: bool,
    /// Threads to use; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    #[command(flatten)]
    pub cache: CacheArguments,
}

/// What to teach.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum What {
    /// Which pixels are the arm, and which the end-effector: one network for a whole frame, and one that looks
    /// at the end-effector from near
    Segmentation,
    /// How the end-effector is turned
    Rotation,
    /// Where keypoints of the end-effector are
    Keypoints,
    /// All of them; with --any-arm the segmentation of whole frames
    All,
}

fn preset() -> impl TypedValueParser<Value = Preset> {
    PossibleValuesParser::new(Preset::NAMES)
        .try_map(|name| Preset::named(&name).ok_or("not a preset"))
}

impl Arguments {
    /// The model whose weights the network of `kind` begins with.
    pub fn from(&self, kind: Kind) -> Option<ModelFiles> {
        if self.from.is_some() || self.from_nothing {
            return self.from.clone();
        }
        let model = ModelFiles::any_arm()?;
        let fits = !self.any_arm && self.preset == Preset::Default && model.has(kind.name());
        fits.then_some(model)
    }

    /// The networks that are asked for.
    pub fn kinds(&self) -> Result<&'static [Kind]> {
        Ok(match self.what {
            What::Segmentation if self.any_arm => &[Kind::Segmentation],
            What::All if self.any_arm => &[Kind::Segmentation],
            _ if self.any_arm => bail!(
                "--any-arm: an end-effector that nobody knows has neither a rotation nor keypoints. Teach \
                 the segmentation, or name a robot"
            ),
            What::Segmentation => &[Kind::Segmentation, Kind::EndEffector],
            What::Rotation => &[Kind::Rotation],
            What::Keypoints => &[Kind::Keypoints],
            What::All => &[Kind::Segmentation, Kind::EndEffector, Kind::Rotation, Kind::Keypoints],
        })
    }
}
