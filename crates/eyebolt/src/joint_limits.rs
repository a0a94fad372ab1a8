//! Joints recorded where the robot description does not let them be.

use eyebolt_robot::{Arm, JointKind, JointPositions};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;

/// A joint outside its limits, at its worst.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OutsideLimits {
    /// Name of the joint.
    pub joint: String,
    /// Name of the frame.
    pub frame: String,
    /// Position there, radians or metres.
    pub position: f64,
    /// Least position allowed.
    pub lower: f64,
    /// Greatest position allowed.
    pub upper: f64,
    /// Whether it turns or slides.
    #[serde(skip)]
    pub kind: JointKind,
}

impl OutsideLimits {
    /// How far outside, radians or metres.
    pub fn beyond(&self) -> f64 {
        (self.lower - self.position).max(self.position - self.upper)
    }
}

impl fmt::Display for OutsideLimits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { joint, frame, position, lower, upper, kind } = self;
        let (unit, stored_as) = match kind {
            JointKind::Prismatic => ("m", "metres if these are millimetres"),
            _ => ("rad", "radians if these are degrees"),
        };
        write!(
            f,
            "joint {joint} is at {position:.3} {unit} in frame {frame}, outside its limits \
             {lower:.3} to {upper:.3}: "
        )?;
        if position.abs() > 2.0 * upper.abs().max(lower.abs()) {
            return write!(f, "store {stored_as}");
        }
        f.write_str("check the order of the joint names, and that the URDF is this robot's")
    }
}

/// The joints outside their limits in some frame, each where it is farthest outside.
#[derive(Debug, Default)]
pub(crate) struct WorstOutside(BTreeMap<String, OutsideLimits>);

impl WorstOutside {
    /// Adds the positions of the joints of `arm` in `frame`.
    pub(crate) fn add(&mut self, arm: &Arm, frame: &str, joints: &JointPositions) {
        for found in arm.joints_outside_limits(joints) {
            let eyebolt_robot::OutsideLimits { joint, kind, position, lower, upper } = found;
            let frame = frame.to_owned();
            let found = OutsideLimits { joint, frame, position, lower, upper, kind };
            let known = self.0.get(&found.joint);
            if known.is_none_or(|known| known.beyond() < found.beyond()) {
                self.0.insert(found.joint.clone(), found);
            }
        }
    }

    /// All of them, sorted by name.
    pub(crate) fn into_vec(self) -> Vec<OutsideLimits> {
        self.0.into_values().collect()
    }

    /// Those that belong to `arm`, sorted by name.
    pub(crate) fn of_arm(self, arm: &Arm) -> Vec<OutsideLimits> {
        let of_the_arm = [arm.required_joints(), arm.other_joints()].concat();
        let mut found = self.into_vec();
        found.retain(|outside| of_the_arm.contains(&outside.joint.as_str()));
        found
    }
}
