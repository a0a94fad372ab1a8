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

/// All of them.
pub const BUILT_IN: &[BuiltIn] = &[BuiltIn {
    name: "shackle",
    urdf: include_str!("../robots/shackle/robot.urdf"),
    about: include_str!("../robots/shackle/robot.toml"),
}];

/// What a robot's `robot.toml` says.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq)]
#[serde(deny_unknown_fields)]
pub struct About {
    /// A line for people.
    pub description: String,
    /// Base link.
    pub base: String,
    /// End-effector link.
    pub end_effector: String,
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
