//! Flags that say what to simulate.

use super::lab_flags::LabArguments;
use super::numbers::{number, pair, range};
use crate::front::Front;
use crate::robots::{Described, DescriptionArguments, told};
use crate::shell::quoted;
use anyhow::Result;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use eyebolt::robots::BuiltIn;
use eyebolt::simulate::{Faults, PRESETS, Preset, Ranges, Viewpoint};
use eyebolt_render::Sensor;
use eyebolt_robot::Arm;

/// Parses the name of a sensor.
pub fn sensor() -> impl TypedValueParser<Value = Sensor> {
    let named = |sensor: &Sensor| PossibleValue::new(sensor.name).help(sensor.about);
    PossibleValuesParser::new(Sensor::ALL.iter().map(named)).try_map(|name| name.parse::<Sensor>())
}

/// Which robot.
#[derive(Debug, clap::Args)]
pub struct RobotArguments {
    /// A robot that comes with the program (shackle, davit, capstan, cleat), a URDF or xacro file with its
    /// meshes, or a robot that is installed for ROS
    #[arg(long, value_name = "NAME|URDF", default_value = "shackle")]
    robot: String,
    /// Base link; otherwise guessed
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// End-effector link; otherwise guessed
    #[arg(long, value_name = "LINK")]
    end_effector: Option<String>,
    #[command(flatten)]
    description: DescriptionArguments,
}

/// An arm with the text that describes it.
pub struct DescribedArm {
    pub arm: Arm,
    pub urdf: String,
}

impl RobotArguments {
    /// The flags that the recording does not make up for: meshes are not part of it.
    pub fn to_calibrate(&self) -> String {
        if BuiltIn::named(&self.robot).is_some() {
            return String::new();
        }
        let robot = format!(" --robot {}", quoted(&self.robot));
        let DescriptionArguments { package_path, xacro_arg } = &self.description;
        let packages = package_path.iter().map(|path| format!(" --package-path {}", quoted(path)));
        let arguments = xacro_arg
            .iter()
            .map(|(name, value)| format!(" --xacro-arg {}", quoted(&format!("{name}={value}"))));
        robot + &packages.chain(arguments).collect::<String>()
    }

    pub fn read(&self, front: &dyn Front) -> Result<DescribedArm> {
        let Described { robot, text: urdf, about } = self.description.named(&self.robot)?;
        let known = about.as_ref();
        let base = self.base.as_deref().or(known.map(|about| about.base.as_str()));
        let hand = self.end_effector.as_deref().or(known.map(|about| about.end_effector.as_str()));
        Ok(DescribedArm { arm: told(robot.arm(base, hand)?, front), urdf })
    }
}

/// Where the camera stands.
#[derive(Debug, clap::Args)]
pub struct CameraArguments {
    /// A pose with a name; otherwise one that the seed chooses within the ranges below
    #[arg(long, value_parser = preset(),
          conflicts_with_all = ["distance_m", "azimuth_deg", "elevation_deg"])]
    preset: Option<&'static Preset>,
    /// Distance from the workspace: one number or a range [default: 0.95,1.5]
    #[arg(long, value_name = "LOW,HIGH", value_parser = range(0.2, 20.0), allow_hyphen_values = true)]
    distance_m: Option<[f64; 2]>,
    /// Direction from the robot, from x toward y; 0 is before it [default: -109,109]
    #[arg(long, value_name = "LOW,HIGH", value_parser = range(-400.0, 400.0), allow_hyphen_values = true)]
    azimuth_deg: Option<[f64; 2]>,
    /// How steeply it looks down [default: 9,49]
    #[arg(long, value_name = "LOW,HIGH", value_parser = range(-90.0, 90.0), allow_hyphen_values = true)]
    elevation_deg: Option<[f64; 2]>,
}

fn preset() -> impl TypedValueParser<Value = &'static Preset> {
    PossibleValuesParser::new(PRESETS.iter().map(|preset| preset.name))
        .try_map(|name| Preset::named(&name).ok_or("not a preset"))
}

impl CameraArguments {
    pub fn viewpoint(&self) -> Viewpoint {
        if let Some(preset) = self.preset {
            return Viewpoint::Preset(preset);
        }
        let ranges = Ranges::default();
        let radians = |degrees: [f64; 2]| degrees.map(f64::to_radians);
        Viewpoint::Within(Ranges {
            distance_m: self.distance_m.unwrap_or(ranges.distance_m),
            azimuth: self.azimuth_deg.map_or(ranges.azimuth, radians),
            elevation: self.elevation_deg.map_or(ranges.elevation, radians),
            ..ranges
        })
    }
}

/// What goes wrong.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Faults")]
pub struct FaultArguments {
    /// Factor of all depth
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0,
          value_parser = number(0.1, 10.0), allow_hyphen_values = true)]
    depth_scale: f64,
    /// Added to all depth, millimetres
    #[arg(long, value_name = "MM", default_value_t = 0.0,
          value_parser = number(-1000.0, 1000.0), allow_hyphen_values = true)]
    depth_offset_mm: f64,
    /// Factor of the focal lengths that the recording states
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0,
          value_parser = number(0.1, 10.0), allow_hyphen_values = true)]
    focal_scale: f64,
    /// Added to the principal point that the recording states, pixels
    #[arg(long, value_name = "X,Y",
          value_parser = pair([-1e4, 1e4], [-1e4, 1e4]), allow_hyphen_values = true)]
    centre_px: Option<[f64; 2]>,
    /// How far each joint is from where it says, one way or the other, degrees
    #[arg(long, value_name = "DEG", default_value_t = 0.0,
          value_parser = number(0.0, 90.0), allow_hyphen_values = true)]
    joint_offset_deg: f64,
    /// Standard deviation of what is added to that, another for each joint, degrees
    #[arg(long, value_name = "DEG", default_value_t = 0.0,
          value_parser = number(0.0, 90.0), allow_hyphen_values = true)]
    joint_offset_sigma_deg: f64,
    /// Play of the joints' gears, degrees: joints lag by half of it, whichever way they came
    #[arg(long, value_name = "DEG", default_value_t = 0.0,
          value_parser = number(0.0, 90.0), allow_hyphen_values = true)]
    backlash_deg: f64,
    /// Added to the stamps of depth, milliseconds
    #[arg(long, value_name = "MS", default_value_t = 0.0,
          value_parser = number(-900.0, 900_000.0), allow_hyphen_values = true)]
    time_skew_ms: f64,
    /// How far one joint, not the first, is from where it says besides, one way or the other, degrees
    #[arg(long, value_name = "DEG", default_value_t = 0.0,
          value_parser = number(0.0, 90.0), allow_hyphen_values = true)]
    one_joint_offset_deg: f64,
    /// How much longer one link is than the description says, millimetres
    #[arg(long, value_name = "MM", default_value_t = 0.0,
          value_parser = number(-100.0, 100.0), allow_hyphen_values = true)]
    link_length_mm: f64,
    /// How much lower the base is than the description says, millimetres: another variant's
    #[arg(long, value_name = "MM", default_value_t = 0.0,
          value_parser = number(-100.0, 100.0), allow_hyphen_values = true)]
    base_lower_mm: f64,
    /// Only the last half of the joints moves: all configurations are alike
    #[arg(long)]
    wrist_only: bool,
    /// Share of the arm that a box before it hides
    #[arg(long, value_name = "SHARE", default_value_t = 0.0,
          value_parser = number(0.0, 0.9), allow_hyphen_values = true)]
    occlusion: f64,
    /// The camera is bumped after half of the configurations, by so many millimetres and degrees
    #[arg(long, value_name = "MM,DEG",
          value_parser = pair([0.0, 1e4], [0.0, 180.0]), allow_hyphen_values = true)]
    bump: Option<[f64; 2]>,
    // Last: its heading goes on to what follows.
    #[command(flatten)]
    lab: LabArguments,
}

impl FaultArguments {
    pub fn faults(&self) -> Faults {
        Faults {
            depth_scale: self.depth_scale,
            depth_offset_m: 1e-3 * self.depth_offset_mm,
            focal_scale: self.focal_scale,
            centre_px: self.centre_px.unwrap_or_default(),
            joint_offset: self.joint_offset_deg.to_radians(),
            joint_offset_sigma: self.joint_offset_sigma_deg.to_radians(),
            backlash: self.backlash_deg.to_radians(),
            time_skew_s: 1e-3 * self.time_skew_ms,
            one_joint_offset: self.one_joint_offset_deg.to_radians(),
            link_length_m: 1e-3 * self.link_length_mm,
            base_lower_m: 1e-3 * self.base_lower_mm,
            wrist_only: self.wrist_only,
            occlusion: self.occlusion,
            bump: self.bump.map(|[mm, deg]| [1e-3 * mm, deg.to_radians()]),
            lab: self.lab.lab(),
        }
    }
}
