//! Robot descriptions that flags name: a robot that comes with the program, a URDF or xacro file, or a
//! robot that is installed for ROS.

use crate::front::Front;
use crate::names;
use anyhow::{Result, bail};
use eyebolt::robots::{About, BUILT_IN, BuiltIn};
use eyebolt_robot::{Arm, Description, PackageRoots, Robot, XacroArguments};
use std::path::Path;

/// How descriptions are read.
#[derive(Clone, Debug, clap::Args)]
pub struct DescriptionArguments {
    /// Where package:// leads: a folder of packages, or NAME=FOLDER; may be repeated.
    /// ROS_PACKAGE_PATH and AMENT_PREFIX_PATH are searched too
    #[arg(long, value_name = "[NAME=]FOLDER")]
    pub package_path: Vec<String>,
    /// Value of an argument of a xacro file; may be repeated
    #[arg(long, value_name = "NAME=VALUE", value_parser = xacro_argument)]
    pub xacro_arg: Vec<(String, String)>,
}

fn xacro_argument(text: &str) -> Result<(String, String), String> {
    // ROS writes NAME:=VALUE.
    let (name, value) = text.split_once(":=").or_else(|| text.split_once('=')).unwrap_or_default();
    match name.is_empty() {
        true => Err("write NAME=VALUE".to_owned()),
        false => Ok((name.to_owned(), value.to_owned())),
    }
}

/// A robot with the text that describes it.
pub struct Described {
    pub robot: Robot,
    /// URDF: what was xacro is expanded.
    pub text: String,
    /// Of a robot that comes with the program: what its URDF does not say.
    pub about: Option<About>,
}

impl DescriptionArguments {
    pub fn packages(&self) -> PackageRoots {
        packages(&self.package_path)
    }

    /// The robot that `name` names.
    pub fn named(&self, name: &str) -> Result<Described> {
        if let Some(known) = BuiltIn::named(name) {
            let robot = known.arm().robot().clone();
            return Ok(Described {
                robot,
                text: known.urdf.to_owned(),
                about: Some(known.about()),
            });
        }
        if Path::new(name).exists() {
            return self.file(Path::new(name));
        }
        match self.packages().descriptions(name).as_slice() {
            [only] => self.file(only),
            [] => bail!(
                "--robot {name}: no such file, nor a robot that comes with the program ({}), nor one that \
                 is installed for ROS (in AMENT_PREFIX_PATH, ROS_PACKAGE_PATH or --package-path). Name \
                 one of them, or a URDF or xacro file",
                BUILT_IN.iter().map(|robot| robot.name).collect::<Vec<_>>().join(", ")
            ),
            // A description that was expanded comes before what it was made of.
            [first, ..] => self.file(first),
        }
    }

    /// The robot that the file at `path` describes.
    pub fn file(&self, path: &Path) -> Result<Described> {
        let packages = self.packages();
        let given: XacroArguments = self.xacro_arg.iter().cloned().collect();
        let description = Description::read(path, &packages, &given)?;
        let robot = description.robot(&packages)?;
        Ok(Described { robot, text: description.text, about: None })
    }
}

/// The packages that flags name, then those that the environment does.
pub fn packages(flags: &[String]) -> PackageRoots {
    let variable = |name| std::env::var(name).ok();
    let (ros, ament) = (variable("ROS_PACKAGE_PATH"), variable("AMENT_PREFIX_PATH"));
    let environment = PackageRoots::from_environment(ros.as_deref(), ament.as_deref());
    let named = flags.iter().fold(PackageRoots::new(), |roots, flag| roots.with_argument(flag));
    named.then(environment)
}

/// `arm`, after what was left out of its description is said.
pub fn told(arm: Arm, front: &dyn Front) -> Arm {
    for part in arm.left_out() {
        front.note(&names::in_flags(&part.to_string()));
    }
    arm
}
