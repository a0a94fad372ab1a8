//! Links and joints as they are spelled, by name.

use crate::robot::{Body, JointKind, JointLimits};
use eyebolt_geometry::{Transform, frame};
use nalgebra::{Unit, Vector3};

pub(crate) struct ParsedLink {
    pub(crate) name: String,
    pub(crate) visuals: Vec<Body>,
    pub(crate) collisions: Vec<Body>,
}

pub(crate) struct ParsedJoint {
    pub(crate) name: String,
    pub(crate) parent: String,
    pub(crate) child: String,
    pub(crate) motion: Motion,
}

/// How a joint moves.
pub(crate) struct Motion {
    pub(crate) kind: JointKind,
    pub(crate) parent_from_child_at_zero: Transform<frame::Link, frame::Link>,
    pub(crate) axis: Unit<Vector3<f64>>,
    pub(crate) limits: Option<JointLimits>,
    pub(crate) most_per_s: Option<f64>,
    pub(crate) mimic: Followed,
}

impl Motion {
    /// Nothing but its kind is known of it.
    pub(crate) fn of(kind: JointKind) -> Self {
        Self {
            kind,
            parent_from_child_at_zero: Transform::identity(),
            axis: Vector3::x_axis(),
            limits: None,
            most_per_s: None,
            mimic: None,
        }
    }
}

/// Name of the joint to follow, multiplier, offset.
pub(super) type Followed = Option<(String, f64, f64)>;
