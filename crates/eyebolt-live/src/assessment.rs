//! What a session knows by now, and what another configuration would add.

use eyebolt::calibrate::{Deviation, Verdict, covariance_at};
use eyebolt::pipeline::Outcome;
use eyebolt_robot::Arm;
use nalgebra::{Matrix3, SymmetricEigen, Vector3};
use serde::Serialize;

/// What a session knows by now.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Assessment {
    /// How many configurations it is of.
    pub configurations: usize,
    /// How many of them nothing spoke against.
    pub used: usize,
    /// Whether the answer would be trusted.
    pub trusted: bool,
    /// Why it would not be.
    pub reasons: Vec<String>,
    /// Where the camera is in the base frame, metres and a Hamilton quaternion `xyzw`; `None` if nothing
    /// was found.
    pub base_from_camera: Option<([f64; 3], [f64; 4])>,
    /// Error to expect at the middle of the workspace, millimetres and degrees.
    pub expected_mm_deg: Option<[f64; 2]>,
    /// The same if one more configuration told as much as those before did on average.
    pub with_another_mm_deg: Option<[f64; 2]>,
    /// The direction in the base frame along which the workspace is known worst, of unit length, with the
    /// standard deviation along it, millimetres.
    pub weakest_direction: Option<([f64; 3], f64)>,
    /// The axis in the base frame about which the rotation is known worst, of unit length, with the
    /// standard deviation about it, degrees.
    pub weakest_axis: Option<([f64; 3], f64)>,
    /// Joints of the arm that hardly moved from one configuration to the other: the links behind them have
    /// shown one side only, and their zeros cannot be told.
    pub idle_joints: Vec<IdleJoint>,
}

/// A joint that hardly moved.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct IdleJoint {
    /// Its name.
    pub joint: String,
    /// The link that it moves.
    pub link: String,
    /// How far it moved over all configurations, degrees.
    pub range_deg: f64,
}

/// A joint that turned less over all configurations hardly moved, radians: what it would tell of its
/// zero is a fifth of a radian's, and of the shape behind it one side only.
const IDLE_RAD: f64 = 0.2;

impl Assessment {
    /// Of the `outcome` with `arm`.
    pub fn of(outcome: &Outcome, arm: &Arm) -> Self {
        let calibration = &outcome.calibration;
        let configurations = calibration.configurations.len();
        let used = calibration.configurations.iter().filter(|c| c.dropped.is_none()).count();
        let reasons = match &calibration.verdict {
            Verdict::Trusted => Vec::new(),
            Verdict::Refused(reasons) => reasons.iter().map(ToString::to_string).collect(),
        };
        let pose = calibration.camera_from_base.as_ref();
        let base_from_camera = pose.map(|pose| pose.inverse());
        let error = calibration.error.as_ref();
        let expected = error.map(|error| error.expected).filter(is_finite);
        let [direction, axis] = match (pose, error) {
            (Some(pose), Some(error)) => {
                let at = covariance_at(&error.covariance, pose, &error.workspace_in_base);
                let turns: Matrix3<f64> = error.covariance.fixed_view::<3, 3>(3, 3).into_owned();
                let base_from_camera = pose.rotation().inverse();
                [at, turns].map(|along| widest(&along, &|axis| base_from_camera * axis))
            }
            _ => [None, None],
        };
        Self {
            configurations,
            used,
            trusted: calibration.verdict == Verdict::Trusted,
            reasons,
            base_from_camera: base_from_camera
                .map(|pose| (pose.translation_m().into(), pose.rotation_xyzw())),
            expected_mm_deg: expected.map(in_words),
            with_another_mm_deg: expected.map(|error| in_words(with_another(&error, used))),
            weakest_direction: direction.map(|(axis, sigma_m)| (axis, 1e3 * sigma_m)),
            weakest_axis: axis.map(|(axis, sigma_rad)| (axis, sigma_rad.to_degrees())),
            idle_joints: idle_joints(outcome, arm),
        }
    }

    /// The expected error; `None` if there is none.
    pub fn expected(&self) -> Option<Deviation> {
        let [mm, deg] = self.expected_mm_deg?;
        Some(Deviation { translation_m: 1e-3 * mm, rotation_rad: deg.to_radians() })
    }
}

fn is_finite(deviation: &Deviation) -> bool {
    deviation.translation_m.is_finite() && deviation.rotation_rad.is_finite()
}

fn in_words(deviation: Deviation) -> [f64; 2] {
    [1e3 * deviation.translation_m, deviation.rotation_rad.to_degrees()]
}

/// The error of `used` configurations and one more: variances are as one to their number.
fn with_another(expected: &Deviation, used: usize) -> Deviation {
    let used = used.max(1) as f64;
    let factor = (used / (used + 1.0)).sqrt();
    Deviation {
        translation_m: factor * expected.translation_m,
        rotation_rad: factor * expected.rotation_rad,
    }
}

/// The direction of the largest variance, turned, and the standard deviation along it. Of the two ways
/// along it, the one whose largest part is positive.
fn widest(
    covariance: &Matrix3<f64>,
    turn: &dyn Fn(Vector3<f64>) -> Vector3<f64>,
) -> Option<([f64; 3], f64)> {
    if !covariance.iter().all(|value| value.is_finite()) {
        return None;
    }
    let eigen = SymmetricEigen::new(*covariance);
    let (index, variance) = eigen.eigenvalues.argmax();
    let axis = turn(eigen.eigenvectors.column(index).into_owned());
    let largest = axis.iter().copied().fold(0.0_f64, |a, b| if b.abs() > a.abs() { b } else { a });
    Some(((axis * largest.signum()).into(), variance.max(0.0).sqrt()))
}

fn idle_joints(outcome: &Outcome, arm: &Arm) -> Vec<IdleJoint> {
    let Some(observations) = &outcome.observations else { return Vec::new() };
    let required = arm.required_joints();
    let joints = observations.arm.joints().iter().enumerate();
    let of_chain = joints.filter(|(_, joint)| required.contains(&joint.name.as_str()));
    let idle = of_chain.filter_map(|(index, joint)| {
        let at = observations.configurations.iter().filter_map(|c| c.joints_rad.get(index));
        let (low, high) = at.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), position| {
            (low.min(*position), high.max(*position))
        });
        let robot = arm.robot();
        let child = robot.joints.get(robot.joint_index(&joint.name)?)?.child;
        let link = robot.links.get(child)?.name.clone();
        let range_deg = (high - low).to_degrees();
        (high - low < IDLE_RAD).then(|| IdleJoint { joint: joint.name.clone(), link, range_deg })
    });
    idle.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::UnitQuaternion;
    use proptest::prelude::*;

    proptest! {
        /// Of an ellipsoid that is turned, the long axis is told, turned back.
        #[test]
        fn the_long_axis_is_found(
            axis in proptest::array::uniform3(-1.0..1.0_f64), angle in 0.0..3.0_f64, long in 2.0..9.0_f64,
        ) {
            let axis = Vector3::from(axis);
            prop_assume!(axis.norm() > 0.1);
            let turn = UnitQuaternion::from_scaled_axis(axis.normalize() * angle);
            let matrix = turn.to_rotation_matrix();
            let variances = Matrix3::from_diagonal(&Vector3::new(1.0, long * long, 0.25));
            let turned = matrix * variances * matrix.transpose();
            let (found, sigma) = widest(&turned, &|axis| turn.inverse() * axis).unwrap();
            prop_assert!((sigma - long).abs() < 1e-9);
            prop_assert!((Vector3::from(found) - Vector3::y()).norm() < 1e-6);
        }

        #[test]
        fn another_always_helps_and_less_each_time(mm in 0.1..50.0_f64, used in 1..40_usize) {
            let error = Deviation { translation_m: 1e-3 * mm, rotation_rad: 0.01 };
            let gain = |used| 1.0 - with_another(&error, used).translation_m / error.translation_m;
            prop_assert!(gain(used) > gain(used + 1) && gain(used + 1) > 0.0);
        }
    }

    #[test]
    fn infinite_covariance_has_no_axis() {
        assert!(widest(&Matrix3::from_element(f64::INFINITY), &|axis| axis).is_none());
    }
}
