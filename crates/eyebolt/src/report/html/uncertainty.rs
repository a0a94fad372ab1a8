//! What the covariance says where the arm works, and what it is made of.

use crate::answer::Answer;
use crate::calibrate::{Deviation, ErrorPart, ErrorSource};
use crate::pipeline::Outcome;
use nalgebra::{Matrix6, Quaternion, UnitQuaternion, Vector3};
use serde::Serialize;

/// Covariance at the middle of the workspace: how far that point is off (m), and the rotation (rad),
/// both along the camera's axes.
pub(super) fn at_workspace(answer: &Answer) -> Option<Matrix6<f64>> {
    let covariance = Matrix6::from_fn(|r, c| answer.covariance.map_or(f64::NAN, |m| m[r][c]));
    let [x, y, z, w] = answer.camera_from_base.as_ref()?.rotation_xyzw;
    let rotation = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
    let arm = rotation * Vector3::from(answer.workspace_in_base_m?);
    let there = moved_to(&arm) * covariance * moved_to(&arm).transpose();
    there.iter().all(|v| v.is_finite()).then_some(there)
}

/// Jacobian of a rigid motion about one point by the same motion about another that is `arm` before
/// it: the rotation stays, and moves the point.
fn moved_to(arm: &Vector3<f64>) -> Matrix6<f64> {
    let mut jacobian = Matrix6::identity();
    jacobian.fixed_view_mut::<3, 3>(0, 3).copy_from(&-arm.cross_matrix());
    jacobian
}

/// Standard deviations along the camera's axes x, y, z: millimetres and degrees.
pub(super) fn deviations(covariance: &Matrix6<f64>) -> [[f64; 2]; 3] {
    let sigma = covariance.diagonal().map(|variance| variance.max(0.0).sqrt());
    [0, 1, 2].map(|axis| [1e3 * sigma[axis], sigma[axis + 3].to_degrees()])
}

/// Correlations, -1 to 1; 0 where nothing varies.
pub(super) fn correlations(covariance: &Matrix6<f64>) -> Matrix6<f64> {
    let sigma = covariance.diagonal().map(|variance| variance.max(0.0).sqrt());
    Matrix6::from_fn(|r, c| {
        let scale = sigma[r] * sigma[c];
        if scale > 0.0 { (covariance[(r, c)] / scale).clamp(-1.0, 1.0) } else { 0.0 }
    })
}

/// A source of the expected error.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Source {
    /// What it is called.
    pub(super) name: &'static str,
    /// How it is found.
    pub(super) how: &'static str,
    /// Its part, which adds up with the others in squares.
    pub(super) translation_mm: f64,
    /// Likewise.
    pub(super) rotation_deg: f64,
    /// Share of the squared translation, percent.
    pub(super) percent: f64,
}

/// What a source of the expected error is called, and how it is found.
fn words(source: ErrorSource) -> [&'static str; 2] {
    match source {
        ErrorSource::Scatter => [
            "scatter of the residuals",
            "sandwich covariance of the fit: the residuals of each link in each view may all be off \
             together",
        ],
        ErrorSource::LeftOut => [
            "dependence on single configurations",
            "jackknife: what the fit would be without each configuration, or of more than ten without each tenth of them",
        ],
        ErrorSource::Disagreement => [
            "disagreement of the kinds of evidence",
            "spread of what surfaces and outlines would say alone: what is wrong in every view alike",
        ],
        ErrorSource::Description => [
            "description and intrinsics",
            "lengths of links, the base and intrinsics that may be off, each as likely as the data make it",
        ],
        ErrorSource::FewConfigurations => [
            "few configurations",
            "an allowance for what leaving configurations out would have told: there are too few of them",
        ],
        ErrorSource::OneKind => [
            "one kind of evidence",
            "an allowance for what outlines would have told: none was seen",
        ],
    }
}

/// What the expected error is made of; empty if there is none.
pub(super) fn sources(outcome: &Outcome) -> Vec<Source> {
    let Some(error) = &outcome.calibration.error else { return Vec::new() };
    let source = |part: &ErrorPart| {
        let [name, how] = words(part.source);
        let Deviation { translation_m, rotation_rad } = part.expected;
        let percent = 100.0 * (translation_m / error.expected.translation_m).powi(2);
        let (translation_mm, rotation_deg) = (1e3 * translation_m, rotation_rad.to_degrees());
        let finite = translation_mm.is_finite() && rotation_deg.is_finite() && percent.is_finite();
        finite.then_some(Source { name, how, translation_mm, rotation_deg, percent })
    };
    error.parts.iter().filter_map(source).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use eyebolt_geometry::{Base, Camera, Transform};
    use nalgebra::{Point3, Vector6};
    use proptest::prelude::*;
    use proptest::test_runner::{Config, RngSeed};

    fn config() -> Config {
        let rng_seed = RngSeed::Fixed(7);
        Config { rng_seed, failure_persistence: None, ..Config::default() }
    }

    fn vector(limit: f64) -> impl Strategy<Value = Vector3<f64>> {
        [-limit..limit, -limit..limit, -limit..limit].prop_map(Vector3::from)
    }

    proptest! {
        #![proptest_config(config())]

        #[test]
        fn moving_a_motion_tells_how_its_point_moves(
            translation in vector(2.0), turn in vector(1.8), step in vector(1e-4),
            spin in vector(1e-4), at in vector(1.0),
        ) {
            let pose = Transform::<Camera, Base>::from_parts(translation, UnitQuaternion::new(turn));
            let motion = Vector6::from_iterator(step.iter().chain(&spin).copied());
            let point = Point3::from(at);
            let moved = pose.retract(&motion).point(&point) - pose.point(&point);
            let told = moved_to(&pose.direction(&at)) * motion;
            prop_assert!((told.fixed_rows::<3>(0) - moved).norm() < 1e-7);
            prop_assert_eq!(told.fixed_rows::<3>(3).into_owned(), spin);
        }

        #[test]
        fn what_varies_alone_goes_with_nothing_else(sigma in prop::array::uniform6(0.0..2.0f64)) {
            let covariance = Matrix6::from_diagonal(&Vector6::from(sigma.map(|s| s * s)));
            let correlations = correlations(&covariance);
            let (mm, deg) = (deviations(&covariance).map(|d| d[0]), deviations(&covariance).map(|d| d[1]));
            for axis in 0..3 {
                prop_assert!((mm[axis] - 1e3 * sigma[axis]).abs() < 1e-9);
                prop_assert!((deg[axis] - sigma[axis + 3].to_degrees()).abs() < 1e-9);
            }
            for (r, c) in (0..6).flat_map(|r| (0..6).map(move |c| (r, c))) {
                let expected = if r == c && sigma[r] > 0.0 { 1.0 } else { 0.0 };
                prop_assert!((correlations[(r, c)] - expected).abs() < 1e-9);
            }
        }
    }
}
