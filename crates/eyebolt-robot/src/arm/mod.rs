//! The part of a robot between a base link and an end-effector link.

mod guess;
mod kinematics;

pub use kinematics::{LinkPoses, PosesWithDefaults};

use crate::error::RobotError;
use crate::joint_positions::JointPositions;
use crate::robot::{Joint, JointKind, Robot};
use std::collections::BTreeSet;

/// A robot with a base link and an end-effector link: the frames of a calibration.
#[derive(Clone, Debug)]
pub struct Arm {
    robot: Robot,
    base: usize,
    end_effector: usize,
    /// Per link: whether it is the base or hangs below it.
    below_base: Vec<bool>,
    /// Per link: whether it is the end-effector or hangs below it.
    below_end_effector: Vec<bool>,
    /// Joints from the base down to the end-effector, fixed ones included.
    chain: Vec<usize>,
}

/// A joint position that its limits do not allow: wrong units, or another joint's value.
#[derive(Clone, Debug, PartialEq)]
pub struct OutsideLimits {
    /// Name of the joint.
    pub joint: String,
    /// Whether it turns or slides.
    pub kind: JointKind,
    /// Recorded position, radians or metres.
    pub position: f64,
    /// Least allowed position.
    pub lower: f64,
    /// Greatest allowed position.
    pub upper: f64,
}

impl Arm {
    pub(crate) fn new(
        robot: Robot,
        base: Option<&str>,
        end_effector: Option<&str>,
    ) -> Result<Self, RobotError> {
        let named = |name: Option<&str>, flag| {
            name.map(|name| {
                robot.link_index(name).ok_or_else(|| RobotError::UnknownLink {
                    file: robot.source.clone(),
                    name: name.to_owned(),
                    flag,
                    known: robot.link_names(),
                })
            })
            .transpose()
        };
        let (base, end_effector) = (named(base, "--base")?, named(end_effector, "--end-effector")?);
        let base = base.map_or_else(|| guess::base(&robot, end_effector), Ok)?;
        let end_effector = end_effector.map_or_else(|| guess::end_effector(&robot, base), Ok)?;
        Self::between(robot, base, end_effector)
    }

    fn between(robot: Robot, base: usize, end_effector: usize) -> Result<Self, RobotError> {
        let chain = robot.chain(base, end_effector).filter(|chain| {
            chain.iter().any(|joint| robot.joints.get(*joint).is_some_and(Joint::moves))
        });
        let Some(chain) = chain else {
            let name = |link: usize| robot.links.get(link).map_or("", |l| &l.name).to_owned();
            return Err(RobotError::NoArm {
                file: robot.source.clone(),
                base: name(base),
                end_effector: name(end_effector),
            });
        };
        let below_base = robot.at_or_below(base);
        let below_end_effector = robot.at_or_below(end_effector);
        Ok(Self { robot, base, end_effector, below_base, below_end_effector, chain })
    }

    /// The whole robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Index of the base link.
    pub fn base(&self) -> usize {
        self.base
    }

    /// Index of the end-effector link.
    pub fn end_effector(&self) -> usize {
        self.end_effector
    }

    /// Name of the base link.
    pub fn base_name(&self) -> &str {
        self.robot.links.get(self.base).map_or("", |link| &link.name)
    }

    /// Name of the end-effector link.
    pub fn end_effector_name(&self) -> &str {
        self.robot.links.get(self.end_effector).map_or("", |link| &link.name)
    }

    /// Whether `link` is the base or below it: what the base stands on is not the arm.
    pub fn is_below_base(&self, link: usize) -> bool {
        self.below_base.get(link).copied().unwrap_or(false)
    }

    /// Indices of the end-effector link and of every link below it, fingers included.
    pub fn end_effector_links(&self) -> Vec<usize> {
        let indices = self.below_end_effector.iter().enumerate();
        indices.filter_map(|(link, below)| below.then_some(link)).collect()
    }

    /// Names of the joints that a recording must have: those that move the end-effector in the
    /// base. Mimic joints stand as the joint that they follow.
    pub fn required_joints(&self) -> Vec<&str> {
        self.sources(self.chain.iter().copied())
    }

    /// Names of the other joints below the base: fingers, a second arm.
    pub fn other_joints(&self) -> Vec<&str> {
        let required = self.required_joints();
        let mut others = self.sources(self.moving_joints_below_base());
        others.retain(|name| !required.contains(name));
        others
    }

    /// Recorded joints that the robot does not have.
    pub fn unknown_joints(&self, positions: &JointPositions) -> Vec<String> {
        let known: BTreeSet<_> =
            self.robot.joints.iter().map(|joint| joint.name.as_str()).collect();
        let names = positions.iter().map(|(name, _)| name);
        names.filter(|name| !known.contains(name)).map(str::to_owned).collect()
    }

    /// Recorded positions outside the limits of their joints, anywhere in the robot. Limits that
    /// leave a joint no room are ones that nobody filled in.
    pub fn joints_outside_limits(&self, positions: &JointPositions) -> Vec<OutsideLimits> {
        let outside = |joint: &Joint| {
            let (position, limits) = (positions.get(&joint.name)?, joint.limits?);
            let allowed = (limits.lower..=limits.upper).contains(&position);
            (!allowed && limits.lower < limits.upper).then(|| OutsideLimits {
                joint: joint.name.clone(),
                kind: joint.kind,
                position,
                lower: limits.lower,
                upper: limits.upper,
            })
        };
        self.robot.joints.iter().filter_map(outside).collect()
    }

    fn moving_joints_below_base(&self) -> impl Iterator<Item = usize> {
        self.robot.joints.iter().enumerate().filter_map(|(index, joint)| {
            let below = self.below_base.get(joint.parent).copied().unwrap_or(false);
            (below && joint.moves()).then_some(index)
        })
    }

    /// Names of the joints that decide the positions of `joints`, each once.
    fn sources(&self, joints: impl Iterator<Item = usize>) -> Vec<&str> {
        let mut names = Vec::new();
        for joint in joints {
            let Some(source) = self.robot.source_joint(joint).filter(|joint| joint.moves()) else {
                continue;
            };
            if !names.contains(&source.name.as_str()) {
                names.push(source.name.as_str());
            }
        }
        names
    }
}

impl Robot {
    /// Joints from link `top` down to link `bottom`; `None` if `bottom` is not below `top`.
    fn chain(&self, top: usize, bottom: usize) -> Option<Vec<usize>> {
        let mut chain = Vec::new();
        let mut link = bottom;
        while link != top {
            let (parent, joint) = self.links.get(link)?.parent?;
            chain.push(joint);
            link = parent;
        }
        chain.reverse();
        Some(chain)
    }

    /// Per link: whether it is `top` or hangs below it.
    fn at_or_below(&self, top: usize) -> Vec<bool> {
        let mut below: Vec<bool> = Vec::with_capacity(self.links.len());
        for (index, link) in self.links.iter().enumerate() {
            // Parents come first, so theirs is known.
            let parent = link.parent.and_then(|(parent, _)| below.get(parent).copied());
            below.push(index == top || parent.unwrap_or(false));
        }
        below
    }

    /// The joint at the end of the chain of mimics that starts at `joint`.
    fn source_joint(&self, joint: usize) -> Option<&Joint> {
        let mut joint = self.joints.get(joint)?;
        while let Some(mimic) = joint.mimic {
            joint = self.joints.get(mimic.joint)?;
        }
        Some(joint)
    }
}
