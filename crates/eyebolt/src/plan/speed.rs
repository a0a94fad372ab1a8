//! How fast joints are moved.

use super::movable::{PlannedJoint, Positions};
use eyebolt_robot::JointKind;

/// How fast each joint is moved at most, and how long the arm rests.
#[derive(Clone, Debug, PartialEq)]
pub struct Speed {
    /// Radians or metres a second.
    most_per_s: Vec<f64>,
}

/// Of a joint's own limit, what is used of it.
const SHARE: f64 = 0.25;
/// The way is followed as a cubic of time that begins and ends at rest: its fastest is so many times its mean.
pub(super) const PEAK: f64 = 1.5;
/// Of no way less, seconds: what is taken for the arm's place may be a little off.
const LEAST_S: f64 = 0.5;

impl Speed {
    /// The fastest joint of `joints` turns at most by `turning_rad_s` and slides by `sliding_m_s`, none faster than a quarter
    /// of its limit.
    pub fn new(joints: &[PlannedJoint], turning_rad_s: f64, sliding_m_s: f64) -> Self {
        let most = |joint: &PlannedJoint| {
            let slow = match joint.kind {
                JointKind::Prismatic => sliding_m_s,
                _ => turning_rad_s,
            };
            joint.most_per_s.map_or(slow, |most| slow.min(SHARE * most))
        };
        Self { most_per_s: joints.iter().map(most).collect() }
    }

    /// How long the straight way between two places takes, at rest at both ends, seconds.
    pub(super) fn straight_s(&self, from: &[f64], to: &[f64]) -> f64 {
        let joints = from.iter().zip(to).zip(&self.most_per_s);
        let longest = joints.map(|((from, to), most)| (to - from).abs() / most).fold(0.0, f64::max);
        (PEAK * longest).max(LEAST_S)
    }

    /// How long a way takes that rests at each of its places.
    pub(super) fn way_s(&self, way: &[Positions]) -> f64 {
        way.windows(2).map(|pair| self.straight_s(&pair[0], &pair[1])).sum()
    }
}
