//! Robots that come with the program, for whoever has none at the desk.

use eyebolt_robot::{Arm, PackageRoots, Robot};
use serde::Deserialize;

/// A robot that comes with the program: all shapes are in its URDF, no file is needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuiltIn {
    /// What it is called.
    pub name: &'static str,
    /// Its description.
    pub urdf: &'static str,
    /// What the URDF does not say, as TOML.
    about: &'static str,
}

macro_rules! built_in {
    ($name:literal) => {
        BuiltIn {
            name: $name,
            urdf: include_str!(concat!("../robots/", $name, "/robot.urdf")),
            about: include_str!(concat!("../robots/", $name, "/robot.toml")),
        }
    };
}

/// All of them.
pub const BUILT_IN: &[BuiltIn] =
    &[built_in!("shackle"), built_in!("davit"), built_in!("capstan"), built_in!("cleat")];

/// What a robot's `robot.toml` says.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct About {
    /// A line for people.
    pub description: String,
    /// Base link.
    pub base: String,
    /// End-effector link.
    pub end_effector: String,
    /// From the axis of the first joint to the end-effector of the stretched arm, metres.
    pub reach_m: f64,
}

impl BuiltIn {
    /// The robot called `name`.
    pub fn named(name: &str) -> Option<&'static Self> {
        BUILT_IN.iter().find(|robot| robot.name == name)
    }

    /// What the URDF does not say.
    pub fn about(&self) -> About {
        toml::from_str(self.about).expect("the robot.toml of every built-in robot is tested")
    }

    /// The arm, with nothing read from disk.
    pub fn arm(&self) -> Arm {
        let about = self.about();
        Robot::from_urdf_str(self.urdf, None, &PackageRoots::new())
            .and_then(|robot| robot.arm(Some(&about.base), Some(&about.end_effector)))
            .expect("every built-in robot is tested")
    }
}
