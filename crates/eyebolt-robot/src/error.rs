//! What can be wrong with a robot description or with joint positions.

use crate::input::Input;
use crate::packages::ResolveError;
use std::path::PathBuf;
use std::sync::Arc;

/// A robot description that cannot be used, or an arm that cannot be picked from it.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RobotError {
    /// The file could not be read.
    #[error("{}: cannot read the URDF: {source}; check the path and the permissions", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: Arc<std::io::Error>,
    },
    /// The text is longer than [`crate::MAX_URDF_BYTES`].
    #[error("{file}: {bytes} bytes, but a URDF may have {limit}; is this a URDF and not a mesh?")]
    TooLarge {
        /// Where the description came from.
        file: String,
        /// Its length.
        bytes: u64,
        /// The longest accepted.
        limit: u64,
    },
    /// Not XML, or XML with a DOCTYPE or its own entities.
    #[error("{file}: not plain XML: {problem}; {remedy}")]
    Xml {
        /// Where the description came from.
        file: String,
        /// What the parser says, with line and column.
        problem: String,
        /// What to do.
        remedy: &'static str,
    },
    /// A xacro file cannot be expanded.
    #[error("{file}, line {line}: {problem}")]
    Xacro {
        /// The file, or one that it includes.
        file: String,
        /// Line of the element, from 1.
        line: u32,
        /// What is wrong and what to do.
        problem: String,
    },
    /// One element or attribute is missing or wrong.
    #[error("{file}, line {line}: {field}: {problem}")]
    Field {
        /// Where the description came from.
        file: String,
        /// Line of the element, from 1.
        line: u32,
        /// Which element and attribute of which link or joint.
        field: String,
        /// What is wrong and what to write instead.
        problem: String,
    },
    /// The links and joints do not form one tree.
    #[error("{file}: {problem}")]
    Tree {
        /// Where the description came from.
        file: String,
        /// What is wrong, with the names, and what to do.
        problem: String,
    },
    /// A mesh file was not found.
    #[error("{file}, link `{link}`: {source}")]
    Mesh {
        /// Where the description came from.
        file: String,
        /// The link that shows the mesh.
        link: String,
        /// Where it was looked for.
        source: ResolveError,
    },
    /// A link was asked for that the robot does not have.
    #[error("{file}: no link `{name}` for {input}; the links are {}", known.join(", "))]
    UnknownLink {
        /// Where the description came from.
        file: String,
        /// The link asked for.
        name: String,
        /// What names it.
        input: Input,
        /// All links.
        known: Vec<String>,
    },
    /// More than one link could be meant.
    #[error("{file}: {what}: {}; name one with {input}", candidates.join(", "))]
    Ambiguous {
        /// Where the description came from.
        file: String,
        /// What could not be decided.
        what: &'static str,
        /// The links to choose from.
        candidates: Vec<String>,
        /// What to name it with.
        input: Input,
    },
    /// The end-effector does not hang on the base by a moving joint.
    #[error(
        "{file}: no moving joint leads from base `{base}` down to end-effector `{end_effector}`; \
         name other links with {} and {}",
        Input::BASE,
        Input::END_EFFECTOR
    )]
    NoArm {
        /// Where the description came from.
        file: String,
        /// The base link.
        base: String,
        /// The end-effector link.
        end_effector: String,
    },
}

impl RobotError {
    /// The input that is at fault, or that would help: for a description that cannot be used, another
    /// description.
    pub fn input(&self) -> Option<Input> {
        match self {
            Self::UnknownLink { input, .. } | Self::Ambiguous { input, .. } => Some(*input),
            Self::NoArm { .. } => Some(Input::END_EFFECTOR),
            Self::Mesh { source, .. } => source.input(),
            Self::Read { .. }
            | Self::TooLarge { .. }
            | Self::Xml { .. }
            | Self::Xacro { .. }
            | Self::Field { .. }
            | Self::Tree { .. } => Some(Input::ROBOT),
        }
    }
}

/// Joint positions that do not tell where the links are.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum KinematicsError {
    /// Joints between base and end-effector have no position.
    #[error(
        "no position for arm joint {}; the recording has {}; \
         record these joints or use the URDF whose joint names match{}",
        quoted(missing),
        listed(recorded),
        prefix_hint(missing, recorded)
    )]
    MissingArmJoints {
        /// Every joint without a position.
        missing: Vec<String>,
        /// Every joint with one.
        recorded: Vec<String>,
    },
    /// Joints elsewhere (fingers, a second arm) have no position.
    #[error(
        "no position for joint {} outside the chain of the arm; the recording has {}; \
         record these joints or let their links take default positions",
        quoted(missing),
        listed(recorded)
    )]
    MissingOtherJoints {
        /// Every joint without a position.
        missing: Vec<String>,
        /// Every joint with one.
        recorded: Vec<String>,
    },
    /// A position is not a number.
    #[error("position of joint `{joint}` is {position}; drop this sample of the recording")]
    NotFinite {
        /// The joint.
        joint: String,
        /// Its position.
        position: f64,
    },
}

/// What all of `missing` lack, or have more, before their names in `recorded`.
pub fn joint_prefix(missing: &[String], recorded: &[String]) -> Option<String> {
    let first = missing.first()?;
    let more = recorded.iter().filter_map(|name| name.strip_suffix(first.as_str()));
    let less = recorded.iter().filter_map(|name| first.strip_suffix(name.as_str()));
    let fits = |prefix: &&str| {
        missing.iter().all(|name| {
            recorded.contains(&format!("{prefix}{name}"))
                || name.strip_prefix(prefix).is_some_and(|rest| recorded.iter().any(|r| r == rest))
        })
    };
    more.chain(less).filter(|prefix| !prefix.is_empty()).find(fits).map(str::to_owned)
}

fn prefix_hint(missing: &[String], recorded: &[String]) -> String {
    joint_prefix(missing, recorded).map_or(String::new(), |prefix| {
        format!("; their names differ by `{prefix}`: give {} {prefix}", Input::JOINT_PREFIX)
    })
}

fn quoted(names: &[String]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

fn listed(names: &[String]) -> String {
    if names.is_empty() { "no joints at all".to_owned() } else { quoted(names) }
}
