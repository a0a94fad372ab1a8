//! The shapes of an arm's links, and the joints whose zeros may be off.

use crate::link_model::LinkModel;
use std::sync::Arc;

/// Joints of one arm whose zeros can be estimated: one more than a redundant arm has.
pub const MOST_JOINTS: usize = 8;

/// A turning joint on the way from the base to the end-effector.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ArmJoint {
    /// The joint's name in the URDF.
    pub name: String,
    /// Which links of the [`ArmModel`] it carries, one entry for each of them.
    pub carries: Vec<bool>,
    /// Whether its zero is a gauge freedom: that of the first joint, which nothing but a view of the
    /// base link itself tells from a turned base. The base frame is then the one that the recorded
    /// joints refer to, and an offset turns the links that the joint does not carry, the other way.
    pub defines_base: bool,
}

impl ArmJoint {
    /// By how much a link turns about the joint's axis for each radian that the joint is off.
    pub(crate) fn turns(&self, link: usize) -> f64 {
        match (self.carries[link], self.defines_base) {
            (true, false) => 1.0,
            (false, true) => -1.0,
            _ => 0.0,
        }
    }
}

/// The shapes of all links of an arm that have one, and the joints whose zeros may be off.
#[derive(Clone, Debug)]
pub struct ArmModel {
    links: Vec<ArmLink>,
    joints: Vec<ArmJoint>,
    /// Whether each link is part of the end-effector; empty if nobody said.
    end_effector: Vec<bool>,
}

/// One link with a shape.
#[derive(Clone, Debug)]
pub struct ArmLink {
    /// The link's name in the URDF.
    pub name: String,
    /// Its shape.
    pub model: Arc<LinkModel>,
}

impl ArmModel {
    /// An arm of these links.
    ///
    /// # Panics
    ///
    /// With more than 255 links.
    pub fn new(links: Vec<ArmLink>) -> Self {
        assert!(links.len() < 256, "an arm of {} links", links.len());
        Self { links, joints: Vec::new(), end_effector: Vec::new() }
    }

    /// The same arm with `joints`, from the base on, of a chain where each carries the next; those
    /// beyond the first [`MOST_JOINTS`] are taken at their word.
    ///
    /// # Panics
    ///
    /// If a joint does not say of each link whether it carries it.
    #[must_use]
    pub fn with_joints(self, mut joints: Vec<ArmJoint>) -> Self {
        let complete = |joint: &ArmJoint| joint.carries.len() == self.links.len();
        assert!(joints.iter().all(complete), "one entry for each link");
        joints.truncate(MOST_JOINTS);
        Self { joints, ..self }
    }

    /// The same arm, of which these links are the end-effector, one entry for each link.
    ///
    /// # Panics
    ///
    /// If there is not one entry for each link.
    #[must_use]
    pub fn with_end_effector(self, end_effector: Vec<bool>) -> Self {
        assert_eq!(end_effector.len(), self.links.len(), "one entry for each link");
        Self { end_effector, ..self }
    }

    /// Whether a link is part of the end-effector.
    pub fn is_end_effector(&self, link: usize) -> bool {
        self.end_effector.get(link).copied().unwrap_or(false)
    }

    /// The joints whose zeros may be off, from the base on; none unless they were given.
    pub fn joints(&self) -> &[ArmJoint] {
        &self.joints
    }

    /// The links, in the order that postures use.
    pub fn links(&self) -> &[ArmLink] {
        &self.links
    }
}
