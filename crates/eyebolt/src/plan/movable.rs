//! An arm whose joints are to be commanded: which of them, how far they go, and where its links are then.

use crate::record::{self, RecordError};
use crate::simulate::ArmBody;
use eyebolt_registration::{ArmModel, LinkCache, Posture};
use eyebolt_robot::{Arm, JointKind, JointPositions};

/// Positions of the joints that are planned, radians or metres, in the order of [`MovableArm::joints`].
pub type Positions = Vec<f64>;

/// An arm with its shapes, the joints that are planned, and where all others stay.
pub struct MovableArm {
    pub(super) body: ArmBody,
    /// As the body's, with the joints whose zeros may be off.
    pub(super) model: ArmModel,
    joints: Vec<PlannedJoint>,
    held: JointPositions,
}

/// A joint that is planned.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedJoint {
    /// Its name.
    pub name: String,
    /// Whether it turns or slides.
    pub kind: JointKind,
    /// Between which positions, radians or metres: a little within its limits.
    pub between: [f64; 2],
    /// How fast it may move, radians or metres a second, if the description says so.
    pub most_per_s: Option<f64>,
}

impl MovableArm {
    /// `arm`, whose joints outside the chain from base to end-effector stay where `held` has them, or where they are
    /// by default.
    ///
    /// # Errors
    ///
    /// Shapes that cannot be read.
    pub fn new(arm: &Arm, held: &JointPositions, cache: &LinkCache) -> Result<Self, RecordError> {
        let mut body = ArmBody::of_described(arm.clone(), cache)?;
        body.hold_all_but(&arm.required_joints());
        let (_, model) = record::offered(arm, &body.links, body.model.clone());
        let model = model.with_end_effector(body.is_end_effector.clone());
        let robot = arm.robot();
        let joints = arm.required_joints().into_iter().filter_map(|name| {
            let joint = robot.joints.get(robot.joint_index(name)?)?;
            let (between, most_per_s) = (body.range(name)?, joint.most_per_s);
            Some(PlannedJoint { name: name.to_owned(), kind: joint.kind, between, most_per_s })
        });
        let joints: Vec<PlannedJoint> = joints.collect();
        let others = arm.other_joints().into_iter().map(|name| {
            let at = held.get(name).unwrap_or_else(|| arm.default_position(name));
            (name.to_owned(), at)
        });
        let held = others.collect();
        Ok(Self { body, model, joints, held })
    }

    /// The joints that are planned, from the base on.
    pub fn joints(&self) -> &[PlannedJoint] {
        &self.joints
    }

    /// Where the other joints stay.
    pub fn held(&self) -> &JointPositions {
        &self.held
    }

    /// The arm.
    pub fn arm(&self) -> &Arm {
        &self.body.arm
    }

    /// All joints with those that are planned at `positions`.
    pub fn all_joints(&self, positions: &[f64]) -> JointPositions {
        let planned = self.joints.iter().zip(positions);
        let planned = planned.map(|(joint, at)| (joint.name.clone(), *at));
        self.held.iter().map(|(name, at)| (name.to_owned(), at)).chain(planned).collect()
    }

    /// Where `joints` has those that are planned; `None` if one is missing.
    pub fn positions_of(&self, joints: &JointPositions) -> Option<Positions> {
        self.joints.iter().map(|joint| joints.get(&joint.name)).collect()
    }

    /// The shapes of its links, with the joints whose zeros may be off.
    pub fn model(&self) -> &ArmModel {
        &self.model
    }

    /// Where `joints` put the links of [`Self::model`], with the axes of its joints. Joints outside the chain that have no
    /// position in it are where they are held; `None` if one of the chain has none.
    pub fn posture_at(&self, joints: &JointPositions) -> Option<Posture> {
        let all = self.held.iter().chain(joints.iter());
        // The last one of a name counts.
        let all = all.map(|(name, at)| (name.to_owned(), at)).collect();
        record::posture(&self.body.arm, &self.model, &all).ok()?
    }

    /// Where the links are, without the axes of the joints.
    pub(super) fn posture(&self, positions: &[f64]) -> Option<Posture> {
        self.body.posture(&self.all_joints(positions))
    }

    /// Where the links are and the joints have their axes.
    pub(super) fn posture_with_axes(&self, positions: &[f64]) -> Option<Posture> {
        record::posture(&self.body.arm, &self.model, &self.all_joints(positions)).ok()?
    }

    /// Whether a joint that is planned moves a link of the model.
    pub(super) fn moves(&self, link: usize) -> bool {
        self.body.moved.get(link).copied().unwrap_or(false)
    }

    /// As [`Self::moves`], of the link of this name.
    pub(super) fn moves_called(&self, link: &str) -> bool {
        let place = self.model.links().iter().position(|own| own.name == link);
        place.is_some_and(|place| self.moves(place))
    }
}
