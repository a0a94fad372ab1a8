//! The chain of joints from a base link to an end-effector link.

use super::guess;
use crate::error::RobotError;
use crate::flaw::LeftOut;
use crate::input::Input;
use crate::joint_positions::JointPositions;
use crate::robot::{Joint, JointKind, Robot};
use std::collections::BTreeSet;

/// A robot with a base link and an end-effector link: the frames of a calibration.
#[derive(Clone, Debug)]
pub struct Arm {
    pub(crate) robot: Robot,
    pub(crate) base: usize,
    pub(super) end_effector: usize,
    /// Per link: whether it is the base or hangs below it.
    pub(super) below_base: Vec<bool>,
    /// Per link: whether it is the end-effector or hangs below it.
    pub(crate) below_end_effector: Vec<bool>,
    /// Joints from the base down to the end-effector, fixed ones included.
    pub(crate) chain: Vec<usize>,
    pub(crate) left_out: Vec<LeftOut>,
    pub(super) guessed: Guessed,
}

/// Which of an arm's links nobody named.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Guessed {
    /// The base link.
    pub base: bool,
    /// The end-effector link.
    pub end_effector: bool,
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

impl Robot {
    /// The arm between two links; `None` lets it be guessed.
    ///
    /// The guessed base is the first link with geometry on the way down from the root through fixed
    /// joints, or a link called `base_link` above that. The guessed end-effector is the first link
    /// with geometry after the last joint of the longest chain, or, where a gripper's joints follow,
    /// the link that carries them. Parts of the description that are wrong and that the arm does not
    /// need are left out: see [`Arm::left_out`].
    ///
    /// # Errors
    /// A link that does not exist, an end-effector that is not below the base through at least one
    /// moving joint, a part of the arm whose description is wrong, or a guess with more than one
    /// answer: the error lists the candidates.
    pub fn arm(&self, base: Option<&str>, end_effector: Option<&str>) -> Result<Arm, RobotError> {
        Arm::new(self.clone(), base, end_effector)
    }
}

impl Arm {
    fn new(
        robot: Robot,
        base: Option<&str>,
        end_effector: Option<&str>,
    ) -> Result<Self, RobotError> {
        let named = |name: Option<&str>, input| {
            name.map(|name| {
                robot.link_index(name).ok_or_else(|| RobotError::UnknownLink {
                    file: robot.source.clone(),
                    name: name.to_owned(),
                    input,
                    known: robot.link_names(),
                })
            })
            .transpose()
        };
        let (base, end_effector) =
            (named(base, Input::BASE)?, named(end_effector, Input::END_EFFECTOR)?);
        let guessed = Guessed { base: base.is_none(), end_effector: end_effector.is_none() };
        // Where joints make no tree, a guess fails for that.
        let says_more = |error| robot.tree_flaw().cloned().unwrap_or(error);
        let base = base.map_or_else(|| guess::base(&robot, end_effector), Ok).map_err(says_more)?;
        let end_effector = end_effector.map_or_else(|| guess::end_effector(&robot, base), Ok);
        let end_effector = end_effector.map_err(says_more)?;
        Self::between(robot, base, end_effector, guessed)
    }

    fn between(
        robot: Robot,
        base: usize,
        end_effector: usize,
        guessed: Guessed,
    ) -> Result<Self, RobotError> {
        let chain = robot.chain(base, end_effector);
        let is_named = |joint: &usize, name: &str| {
            robot.joints.get(*joint).is_some_and(|joint| joint.name == name)
        };
        let on_the_way = |name: &str| chain.iter().flatten().any(|joint| is_named(joint, name));
        if let Some(error) = robot.joint_flaw(on_the_way) {
            return Err(error.clone());
        }
        let chain = chain.filter(|chain| {
            chain.iter().any(|joint| robot.joints.get(*joint).is_some_and(Joint::moves))
        });
        let Some(chain) = chain else {
            // Where nothing moves, what was wrong with a joint says more.
            if let Some(error) = robot.joint_flaw(|_| true) {
                return Err(error.clone());
            }
            let name = |link: usize| robot.links.get(link).map_or("", |l| &l.name).to_owned();
            return Err(RobotError::NoArm {
                file: robot.source.clone(),
                base: name(base),
                end_effector: name(end_effector),
            });
        };
        let below_base = robot.at_or_below(base);
        let below_end_effector = robot.at_or_below(end_effector);
        let left_out = Vec::new();
        Self { robot, base, end_effector, below_base, below_end_effector, chain, left_out, guessed }
            .without_flaws()
    }

    /// Parts of the description that are wrong, and left out since this arm does not need them.
    pub fn left_out(&self) -> &[LeftOut] {
        &self.left_out
    }

    /// Which of base and end-effector nobody named.
    pub fn guessed(&self) -> Guessed {
        self.guessed
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

    pub(super) fn moving_joints_below_base(&self) -> impl Iterator<Item = usize> {
        self.robot.joints.iter().enumerate().filter_map(|(index, joint)| {
            let below = self.below_base.get(joint.parent).copied().unwrap_or(false);
            (below && joint.moves()).then_some(index)
        })
    }

    /// Names of the joints that decide the positions of `joints`, each once.
    pub(super) fn sources(&self, joints: impl Iterator<Item = usize>) -> Vec<&str> {
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
