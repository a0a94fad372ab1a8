//! Flags that say what is in the laboratory.

use super::numbers::number;
use eyebolt::simulate::{Lab, SecondArm};

/// What is there that neither a description nor a tidy room has.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Laboratory")]
pub struct LabArguments {
    /// Share of the arm that glosses: depth fails there in patches
    #[arg(long, value_name = "SHARE", default_value_t = 0.0,
          value_parser = number(0.0, 0.9), allow_hyphen_values = true)]
    gloss: f64,
    /// Walls are 4 to 6 metres away instead of 2 to 3
    #[arg(long)]
    far_room: bool,
    /// Error of depth at one metre that grows with its square, smooth in the image and another in each
    /// configuration, millimetres
    #[arg(long, value_name = "MM", default_value_t = 0.0,
          value_parser = number(0.0, 100.0), allow_hyphen_values = true)]
    wander_mm: f64,
    /// Length of a tool that the description lacks, millimetres
    #[arg(long, value_name = "MM", default_value_t = 0.0,
          value_parser = number(0.0, 1000.0), allow_hyphen_values = true)]
    tool_mm: f64,
    /// A cable along the arm that the description lacks
    #[arg(long)]
    cable: bool,
    /// A cover on a link that the description lacks
    #[arg(long)]
    cover: bool,
    /// People and boxes that are elsewhere in each configuration
    #[arg(long, value_name = "COUNT", default_value_t = 0, value_parser = clap::value_parser!(u16).range(0..=50))]
    passers_by: u16,
    /// Share of the configurations with another room behind them
    #[arg(long, value_name = "SHARE", default_value_t = 0.0,
          value_parser = number(0.0, 1.0), allow_hyphen_values = true)]
    other_rooms: f64,
    /// Another arm of the same kind beside
    #[arg(long, value_enum)]
    second_arm: Option<SecondArmName>,
    /// How strong the camera's fixed pattern of rings and bands is; 1 is a Kinect v1
    #[arg(long, value_name = "FACTOR", default_value_t = 0.0,
          value_parser = number(0.0, 10.0), allow_hyphen_values = true)]
    fixed_pattern: f64,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum SecondArmName {
    /// It rests all the time
    Still,
    /// It rests elsewhere in each configuration
    Moving,
}

impl LabArguments {
    pub fn lab(&self) -> Lab {
        Lab {
            gloss: self.gloss,
            far_room: self.far_room,
            wander_m: 1e-3 * self.wander_mm,
            tool_m: 1e-3 * self.tool_mm,
            cable: self.cable,
            cover: self.cover,
            passers_by: usize::from(self.passers_by),
            other_rooms: self.other_rooms,
            second_arm: match self.second_arm {
                None => SecondArm::None,
                Some(SecondArmName::Still) => SecondArm::Still,
                Some(SecondArmName::Moving) => SecondArm::Moving,
            },
            fixed_pattern: self.fixed_pattern,
        }
    }
}
