//! Options of `eyebolt plan`.

use crate::inputs::{BagArguments, CacheArguments, RobotArguments, positive};
use crate::output::STDOUT;
use anyhow::{Result, bail};
use eyebolt_recording::Recording;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Camera's file:
  A calibration of eyebolt, or JSON of what you measured with a tape, to a hand's breadth and a few degrees:

    {\"camera_from_base\": {\"translation_m\": [0.05, 0.04, 1.31], \"rotation_xyzw\": [0.776, 0.421, -0.403, 0.241]},
     \"intrinsics\": {\"width\": 640, \"height\": 480, \"fx\": 590, \"fy\": 590, \"cx\": 320, \"cy\": 240},
     \"range_m\": [0.3, 3.0]}

  camera_from_base maps coordinates in the base link to coordinates in the depth optical frame (x right, y down, z
  forward). Without a recording and without it, the plan is good for cameras before and beside the arm, on average.

eyebolt moves no arm: give --as trajectory to a controller, or --as moveit to a planner, after you have looked at it.";

/// Options of `eyebolt plan`.
#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Arguments {
    /// What was recorded so far, of which the plan is to be the continuation: folder or bag. Its calibration says where the
    /// camera is, and its depth what is about the arm
    pub recording: Option<PathBuf>,
    /// Where the camera is: a calibration, or JSON with camera_from_base and intrinsics (see below). With a recording,
    /// that is not calibrated anew
    #[arg(long, value_name = "FILE")]
    pub camera: Option<PathBuf>,
    /// How many configurations
    #[arg(short = 'n', long, value_name = "COUNT", default_value_t = 6, value_parser = clap::value_parser!(u16).range(1..=12))]
    pub configurations: u16,
    /// Where to write the plan; - is standard output
    #[arg(short, long, value_name = "FILE", default_value = "next.json")]
    pub output: PathBuf,
    /// What to write [default: trajectory to .yaml, else json]
    #[arg(long = "as", value_name = "FORM")]
    form: Option<Form>,
    #[command(flatten)]
    pub robot: RobotArguments,
    /// Take no table to be there: the arm stands on a column, or hangs
    #[arg(long)]
    pub no_table: bool,
    /// Let the arm be only where the camera saw through, or where the arm was
    #[arg(long, requires = "recording")]
    pub seen_only: bool,
    /// Go by a calibration that was refused, too
    #[arg(long)]
    pub even_if_refused: bool,
    /// How fast joints turn at most, degrees a second; none faster than a quarter of its limit
    #[arg(long, value_name = "DEG_S", default_value_t = 12.0, value_parser = positive)]
    pub speed_deg_s: f64,
    /// How fast joints slide at most, metres a second
    #[arg(long, value_name = "M_S", default_value_t = 0.05, value_parser = positive)]
    pub speed_m_s: f64,
    /// How long the arm rests in each configuration, seconds
    #[arg(long, value_name = "S", default_value_t = 3.0, value_parser = positive)]
    pub rest_s: f64,
    /// Find the arm's pixels without the recording's masks
    #[arg(long)]
    pub no_masks: bool,
    /// Replace an existing file
    #[arg(long)]
    pub force: bool,
    /// Seed of all random choices; the same seed gives the same plan on any number of threads
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Threads to use; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    #[command(flatten)]
    pub cache: CacheArguments,
    #[command(flatten)]
    bag: BagArguments,
}

/// What a plan is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Form {
    /// All that is known of the plan, with what each configuration gains
    Json,
    /// YAML: by name a moveit_msgs/RobotState each, targets for a planner that finds its own way
    Moveit,
    /// YAML: a trajectory_msgs/JointTrajectory along the way that was checked
    Trajectory,
}

impl Form {
    const fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Json => &["json"],
            Self::Moveit | Self::Trajectory => &["yaml", "yml"],
        }
    }
}

impl Arguments {
    /// What to write, by the flag or by how the output's name ends.
    pub fn form(&self) -> Result<Form> {
        let ending = self.output.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        let by_ending = match ending.as_deref() {
            Some("yaml" | "yml") => Form::Trajectory,
            _ => Form::Json,
        };
        let form = self.form.unwrap_or(by_ending);
        let fits = ending.as_deref().is_some_and(|ending| form.endings().contains(&ending));
        if !fits && self.output != Path::new(STDOUT) {
            let [usual, ..] = form.endings() else { return Ok(form) };
            bail!("{}: --output: the plan is {usual}. Give .{usual} for it", self.output.display());
        }
        Ok(form)
    }

    /// Opens the recording at `path`.
    pub fn open(&self, path: &Path) -> Result<Recording<'static>> {
        Ok(Recording::open(path, &self.bag.options_of(&self.robot))?)
    }
}
