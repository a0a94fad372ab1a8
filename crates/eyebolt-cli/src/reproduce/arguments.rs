//! What `eyebolt reproduce` is asked for.

use crate::inputs::model_files;
use eyebolt::model_files::ModelFiles;
use std::path::PathBuf;

/// Options of `eyebolt reproduce`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Folder for all of it; what is there already is not made again
    #[arg(short, long, value_name = "FOLDER", default_value = "reproduction")]
    pub output: PathBuf,
    /// A robot that comes with the program, or a URDF with its meshes
    #[arg(long, value_name = "NAME|URDF", default_value = "shackle")]
    pub robot: String,
    /// In ten minutes instead of hours: fewer frames, and networks that have hardly learned
    #[arg(long)]
    pub quick: bool,
    /// Evaluate this model, its folder or one that comes with the program, instead of recording, labelling and training
    #[arg(long, value_name = "MODEL", value_parser = model_files())]
    pub model: Option<ModelFiles>,
    /// Also teach networks on each of the three training poses alone, and evaluate each on each test pose
    #[arg(long, conflicts_with = "model")]
    pub each: bool,
    /// Steps of each network [default: 20000, or 400 with --quick]
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..=100_000_000), conflicts_with = "model")]
    pub steps: Option<u64>,
    /// Begin with the weights of another model, as far as they fit
    #[arg(long, value_name = "MODEL", value_parser = model_files(), conflicts_with = "model")]
    pub from: Option<ModelFiles>,
}
