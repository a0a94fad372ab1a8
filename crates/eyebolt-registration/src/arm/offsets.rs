//! Joint zeros that may be off, and the axes that they turn about.

use super::model::MOST_JOINTS;
use nalgebra::{Isometry3, Point3, Translation3, Unit, UnitQuaternion, Vector3};

/// Where a joint's axis is while the arm is in one configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointAxis {
    /// A point on it, base frame, metres.
    pub through_in_base: Point3<f64>,
    /// Its direction, base frame.
    pub along_in_base: Unit<Vector3<f64>>,
}

/// How the joints of an [`ArmModel`](super::ArmModel) differ from what they say and from their description;
/// zero beyond its last joint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointOffsets {
    /// How much farther each stands than it says, in the order of
    /// [`ArmModel::joints`](super::ArmModel::joints).
    pub rad: [f64; MOST_JOINTS],
    /// How much farther each is from the joint before it than described: what the link between them is
    /// longer. Zero for the first, whose place is the base's, and for joints of one housing.
    pub lengths_m: [f64; MOST_JOINTS],
}

impl JointAxis {
    /// Turns whatever hangs on the joint further by `angle` radians.
    pub(crate) fn turn(&self, angle: f64) -> Isometry3<f64> {
        let rotation = UnitQuaternion::from_axis_angle(&self.along_in_base, angle);
        let through = self.through_in_base.coords;
        Isometry3::from_parts(Translation3::from(through - rotation * through), rotation)
    }

    /// Derivative of `gradient . point` by the angle of a joint that carries the point; both in the
    /// base frame.
    pub(crate) fn derivative(&self, gradient: &Vector3<f64>, point: &Point3<f64>) -> f64 {
        self.along_in_base.dot(&(point - self.through_in_base).cross(gradient))
    }
}
