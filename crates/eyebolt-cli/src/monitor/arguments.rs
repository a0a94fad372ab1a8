//! How `eyebolt monitor` is asked for.

use crate::inputs::{BagArguments, CacheArguments, RobotArguments, positive};
use anyhow::{Result, bail};
use eyebolt::export::SavedCalibration;
use eyebolt::monitor::Rate;
use eyebolt::record::RecordOptions;
use eyebolt_robot::Arm;
use std::path::PathBuf;

/// Options of `eyebolt monitor`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The calibration to watch
    pub calibration: PathBuf,
    /// Folder with a recording.toml, or a bag: MCAP, rosbag2 (file or folder) or ROS 1
    #[cfg_attr(not(feature = "live"), arg(required = true))]
    #[cfg_attr(
        feature = "live",
        arg(required_unless_present = "ros_domain", conflicts_with = "ros_domain")
    )]
    pub recording: Option<PathBuf>,
    #[cfg(feature = "live")]
    #[command(flatten)]
    pub domain: crate::live::domain::DomainArguments,
    #[command(flatten)]
    pub bag: BagArguments,
    #[command(flatten)]
    pub robot: RobotArguments,
    /// False alarms that are allowed in an hour, on average
    #[arg(long, value_name = "NUMBER", default_value_t = Rate::default().false_alarms_per_hour, value_parser = positive)]
    pub false_alarms_per_hour: f64,
    /// How many resting views there are in an hour
    #[arg(long, value_name = "NUMBER", default_value_t = Rate::default().views_per_hour, value_parser = positive)]
    pub views_per_hour: f64,
    /// How many frames of each rest are looked at
    #[arg(long, value_name = "NUMBER", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..))]
    pub per_rest: u16,
    /// Watch a calibration that was refused, too
    #[arg(long)]
    pub even_if_refused: bool,
    /// Find the arm's pixels without the recording's masks
    #[arg(long)]
    pub no_masks: bool,
    /// JSON, a line for each view, instead of text
    #[arg(long)]
    pub json: bool,
    /// Threads to use; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    #[command(flatten)]
    pub cache: CacheArguments,
}

/// Of the recording's configurations, as many as tell the camera and the noise of its depth.
pub const FEW: usize = 2;

/// The calibration is of the arm's base, or what it says is of another frame.
pub fn check_base(calibration: &SavedCalibration, arm: &Arm) -> Result<()> {
    if calibration.base_frame.as_str() == arm.base_name() {
        return Ok(());
    }
    bail!(
        "{}: frames.base: the calibration is of {}, but the arm's base is {}. Name it with --base, or give \
         another calibration",
        calibration.file(),
        calibration.base_frame.as_str(),
        arm.base_name()
    )
}

impl Arguments {
    /// What to read of frames.
    pub fn options(&self) -> RecordOptions {
        RecordOptions { use_masks: !self.no_masks, most_configurations: FEW }
    }

    /// How often there may be false alarms.
    pub fn rate(&self) -> Rate {
        Rate {
            views_per_hour: self.views_per_hour,
            false_alarms_per_hour: self.false_alarms_per_hour,
        }
    }
}
