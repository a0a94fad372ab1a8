//! Flags that say what to simulate.

use crate::inputs::packages;
use anyhow::{Context, Result, bail};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use eyebolt::robots::{BUILT_IN, BuiltIn};
use eyebolt::simulate::{Faults, PRESETS, Preset, Ranges, Viewpoint};
use eyebolt_render::Sensor;
use eyebolt_robot::{Arm, Robot};
use std::path::Path;

/// Parses the name of a sensor.
pub fn sensor() -> impl TypedValueParser<Value = Sensor> {
    let named = |sensor: &Sensor| PossibleValue::new(sensor.name).help(sensor.about);
    PossibleValuesParser::new(Sensor::ALL.iter().map(named)).try_map(|name| name.parse::<Sensor>())
}

/// Which robot.
#[derive(Debug, clap::Args)]
pub struct RobotArguments {
    /// A robot that comes with the program (shackle), or a URDF with its meshes
    #[arg(long, value_name = "NAME|URDF", default_value = "shackle")]
    robot: String,
    /// Base link; otherwise guessed
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// End-effector link; otherwise guessed
    #[arg(long, value_name = "LINK")]
    end_effector: Option<String>,
    /// Where package:// leads: a folder of packages, or NAME=FOLDER; may be repeated.
    /// ROS_PACKAGE_PATH and AMENT_PREFIX_PATH are searched too
    #[arg(long, value_name = "[NAME=]FOLDER")]
    package_path: Vec<String>,
}

/// An arm with the text that describes it.
pub struct DescribedArm {
    pub arm: Arm,
    pub urdf: String,
}

impl RobotArguments {
    pub fn read(&self) -> Result<DescribedArm> {
        let (robot, urdf, about) = match BuiltIn::named(&self.robot) {
            Some(known) => {
                let arm = known.arm();
                (arm.robot().clone(), known.urdf.to_owned(), Some(known.about()))
            }
            None => {
                let path = Path::new(&self.robot);
                if !path.exists() {
                    let known: Vec<&str> = BUILT_IN.iter().map(|robot| robot.name).collect();
                    bail!(
                        "--robot {}: no such file, nor a robot that comes with the program ({}). \
                         Name one of them, or a URDF",
                        self.robot,
                        known.join(", ")
                    );
                }
                let robot = Robot::from_urdf_file(path, &packages(&self.package_path))?;
                let failed = || format!("{}: cannot read the URDF", path.display());
                (robot, std::fs::read_to_string(path).with_context(failed)?, None)
            }
        };
        let known = about.as_ref();
        let base = self.base.as_deref().or(known.map(|about| about.base.as_str()));
        let hand = self.end_effector.as_deref().or(known.map(|about| about.end_effector.as_str()));
        Ok(DescribedArm { arm: robot.arm(base, hand)?, urdf })
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
    #[arg(long, value_name = "LOW,HIGH", value_delimiter = ',', num_args = 1..=2)]
    distance_m: Vec<f64>,
    /// Direction from the robot, from x toward y; 0 is before it [default: -109,109]
    #[arg(long, value_name = "LOW,HIGH", value_delimiter = ',', num_args = 1..=2, allow_negative_numbers = true)]
    azimuth_deg: Vec<f64>,
    /// How steeply it looks down [default: 9,49]
    #[arg(long, value_name = "LOW,HIGH", value_delimiter = ',', num_args = 1..=2, allow_negative_numbers = true)]
    elevation_deg: Vec<f64>,
}

fn preset() -> impl TypedValueParser<Value = &'static Preset> {
    PossibleValuesParser::new(PRESETS.iter().map(|preset| preset.name))
        .try_map(|name| Preset::named(&name).ok_or("not a preset"))
}

impl CameraArguments {
    pub fn viewpoint(&self) -> Result<Viewpoint> {
        if let Some(preset) = self.preset {
            return Ok(Viewpoint::Preset(preset));
        }
        let ranges = Ranges::default();
        let radians = |degrees: &f64| degrees.to_radians();
        let azimuth: Vec<f64> = self.azimuth_deg.iter().map(radians).collect();
        let elevation: Vec<f64> = self.elevation_deg.iter().map(radians).collect();
        Ok(Viewpoint::Within(Ranges {
            distance_m: range("--distance-m", &self.distance_m, ranges.distance_m, [0.2, 20.0])?,
            azimuth: range("--azimuth-deg", &azimuth, ranges.azimuth, [-7.0, 7.0])?,
            elevation: range("--elevation-deg", &elevation, ranges.elevation, [-1.6, 1.6])?,
            ..ranges
        }))
    }
}

/// Two numbers, or one twice, within `allowed`.
fn range(flag: &str, given: &[f64], default: [f64; 2], allowed: [f64; 2]) -> Result<[f64; 2]> {
    let found = match given {
        [] => return Ok(default),
        [one] => [*one; 2],
        [low, high, ..] => [*low, *high],
    };
    let within = |value: &f64| (allowed[0]..=allowed[1]).contains(value);
    if !(found.iter().all(within) && found[0] <= found[1]) {
        bail!("{flag}: not a range that a camera can be in. Give LOW,HIGH, such as the default");
    }
    Ok(found)
}

/// What goes wrong.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Faults")]
pub struct FaultArguments {
    /// Factor of all depth
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0)]
    depth_scale: f64,
    /// Added to all depth, millimetres
    #[arg(long, value_name = "MM", default_value_t = 0.0, allow_negative_numbers = true)]
    depth_offset_mm: f64,
    /// Factor of the focal lengths that the recording states
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0)]
    focal_scale: f64,
    /// Added to the principal point that the recording states, pixels
    #[arg(long, value_name = "X,Y", value_delimiter = ',', num_args = 1..=2, allow_negative_numbers = true)]
    centre_px: Vec<f64>,
    /// How far each joint is from where it says, one way or the other, degrees
    #[arg(long, value_name = "DEG", default_value_t = 0.0)]
    joint_offset_deg: f64,
    /// How far joints lag behind what they say, degrees
    #[arg(long, value_name = "DEG", default_value_t = 0.0)]
    backlash_deg: f64,
    /// Added to the stamps of depth, milliseconds
    #[arg(long, value_name = "MS", default_value_t = 0.0, allow_negative_numbers = true)]
    time_skew_ms: f64,
    /// The camera is bumped after half of the configurations: by how much
    #[arg(long, value_name = "MM,DEG", value_delimiter = ',', num_args = 1..=2)]
    bump: Vec<f64>,
}

impl FaultArguments {
    pub fn faults(&self) -> Result<Faults> {
        let pair = |given: &[f64]| match given {
            [] => None,
            [one] => Some([*one, 0.0]),
            [first, second, ..] => Some([*first, *second]),
        };
        let limits = [
            ("--depth-scale", self.depth_scale, [0.1, 10.0]),
            ("--depth-offset-mm", self.depth_offset_mm, [-1000.0, 1000.0]),
            ("--focal-scale", self.focal_scale, [0.1, 10.0]),
            ("--joint-offset-deg", self.joint_offset_deg, [0.0, 90.0]),
            ("--backlash-deg", self.backlash_deg, [0.0, 90.0]),
            ("--time-skew-ms", self.time_skew_ms, [-900.0, 900_000.0]),
        ];
        let lists = [("--centre-px", &self.centre_px, 1e4), ("--bump", &self.bump, 1e4)];
        let listed = lists.into_iter().flat_map(|(flag, values, limit)| {
            values.iter().map(move |value| (flag, *value, [-limit, limit]))
        });
        for (flag, value, [low, high]) in limits.into_iter().chain(listed) {
            if !(low..=high).contains(&value) {
                bail!("{flag}: {value} is out of range. Give a number from {low} to {high}");
            }
        }
        Ok(Faults {
            depth_scale: self.depth_scale,
            depth_offset_m: 1e-3 * self.depth_offset_mm,
            focal_scale: self.focal_scale,
            centre_px: pair(&self.centre_px).unwrap_or_default(),
            joint_offset: self.joint_offset_deg.to_radians(),
            backlash: self.backlash_deg.to_radians(),
            time_skew_s: 1e-3 * self.time_skew_ms,
            bump: pair(&self.bump).map(|[mm, deg]| [1e-3 * mm, deg.to_radians()]),
        })
    }
}
