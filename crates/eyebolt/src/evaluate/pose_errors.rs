//! How far poses of an end-effector are off.

use crate::pose::{EndEffectorShape, ExpectedError, PoseAnswer};
use eyebolt_geometry::{Camera, EndEffector, Transform};
use eyebolt_robot::JointPositions;

/// Points that the mean distance of points (ADD) goes over.
const POINTS: usize = 1000;
/// An answer that is off by more is a wrong one, ADD in millimetres.
const WRONG_MM: f64 = 10.0;
/// Three numbers are within this many times their root mean square 95 times of a hundred (chi-square of three degrees
/// of freedom).
const BOUND_95: f64 = 1.614;

/// Errors of the poses that one method found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PoseErrors {
    /// Frames looked at.
    pub frames: usize,
    /// Of those answered, millimetres.
    pub translation_mm: Vec<f64>,
    /// Of those answered, degrees.
    pub rotation_deg: Vec<f64>,
    /// Mean distance of the end-effector's points under the two poses (ADD; Hinterstoisser et al., ACCV 2012), of
    /// those answered, millimetres.
    pub add_mm: Vec<f64>,
    /// How many of those answered told an error to expect, and how many of these were within its 95 % bound.
    pub told: usize,
    /// See `told`.
    pub within_bound: usize,
}

/// Mean and standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub deviation: f64,
}

impl Statistics {
    /// Of `values`; `None` of none.
    pub fn of(values: &[f64]) -> Option<Self> {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count;
        (!values.is_empty()).then(|| Self { mean, deviation: variance.sqrt() })
    }
}

impl PoseErrors {
    /// Counts a frame in which `found` was found with the joints at `joints`, and `truth` is true. Refused answers
    /// are none; a turn that cannot be seen is no error.
    pub fn add(
        &mut self,
        shape: &EndEffectorShape,
        joints: &JointPositions,
        found: Option<&PoseAnswer>,
        truth: &Transform<Camera, EndEffector>,
    ) {
        self.frames += 1;
        let Some(found) = found.filter(|found| found.refusal.is_none()) else { return };
        let pose = found.camera_from_end_effector.isometry();
        let (metres, radians) = shape.apart(pose, truth.isometry());
        let points = shape.end_effector.points(joints, POINTS);
        let add = |twin: &nalgebra::Isometry3<f64>| {
            let truth = truth.isometry() * twin;
            let off = points.iter().map(|point| (pose * point - truth * point).norm());
            off.sum::<f64>() / points.len().max(1) as f64
        };
        let add = shape.twins().iter().map(add).fold(f64::INFINITY, f64::min);
        self.translation_mm.push(1e3 * metres);
        self.rotation_deg.push(radians.to_degrees());
        self.add_mm.push(1e3 * add);
        if let Some(ExpectedError { translation_mm, rotation_deg }) = found.expected_error {
            self.told += 1;
            let within = 1e3 * metres <= BOUND_95 * translation_mm
                && radians.to_degrees() <= BOUND_95 * rotation_deg;
            self.within_bound += usize::from(within);
        }
    }

    /// Counts what `other` counted.
    pub fn merge(&mut self, other: &Self) {
        self.frames += other.frames;
        self.translation_mm.extend(&other.translation_mm);
        self.rotation_deg.extend(&other.rotation_deg);
        self.add_mm.extend(&other.add_mm);
        self.told += other.told;
        self.within_bound += other.within_bound;
    }

    /// Frames answered.
    pub fn answered(&self) -> usize {
        self.add_mm.len()
    }

    /// Of those, how many are wrong: off by more than a centimetre.
    pub fn wrong(&self) -> usize {
        self.add_mm.iter().filter(|add| **add > WRONG_MM).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_and_deviation_by_hand() {
        let found = Statistics::of(&[1.0, 2.0, 3.0, 6.0]).unwrap();
        assert_eq!((found.mean, found.deviation), (3.0, (14.0_f64 / 4.0).sqrt()));
        assert_eq!(Statistics::of(&[]), None);
    }
}
