//! How far off an answer is expected to be.
//!
//! Three sources, each seen by another experiment: the scatter of the residuals (the sandwich
//! covariance of the refinement), what changes when configurations are left out (jackknife), and
//! what is wrong in every frame alike, which neither of these can see: it shows where the two kinds
//! of evidence, surfaces and outlines, disagree.
//!
//! Offsets of joints are unknowns in all three. One that nothing determines is as uncertain as this
//! arm's offsets are large, and the pose is with it.

use super::Work;
use crate::refine::{LEAVE_ONE_OUT, ONE_SIDED};
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::{
    JointPrior, MOST_JOINTS, RefineOptions, RefineView, Refinement, Start, Trust,
};
use nalgebra::{Matrix3, Matrix6, Point3, SMatrix, SVector, Vector3, Vector6};

/// A difference between two poses, or its expected size.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Distance that the centre of the workspace moves, metres.
    pub translation_m: f64,
    /// Angle, radians.
    pub rotation_rad: f64,
}

/// How far off an answer is expected to be.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorEstimate {
    /// Root mean square error to expect, of all sources together.
    pub expected: Deviation,
    /// Covariance of the answer, translation (m) then rotation (rad), in the answer's frame, as
    /// [`Transform::retract`] has them; all sources together.
    pub covariance: Matrix6<f64>,
    /// What each configuration changes when it is left out, in the order of those used; `None`
    /// with fewer than three of them.
    pub leave_one_out: Option<Vec<Deviation>>,
    /// Difference between the answers that surfaces alone and outlines alone would give; `None`
    /// where no outline was seen.
    pub disagreement: Option<Deviation>,
    /// Centre of the workspace, base frame: where errors are measured.
    pub workspace_in_base: Point3<f64>,
    /// Standard deviation of each joint's offset, radians, of all sources together.
    pub joint_sigma_rad: [f64; MOST_JOINTS],
}

impl ErrorEstimate {
    /// The largest deviation of any configuration left out.
    pub fn worst_left_out(&self) -> Option<Deviation> {
        let all = self.leave_one_out.as_ref()?;
        Some(all.iter().fold(Deviation::default(), |worst, d| Deviation {
            translation_m: worst.translation_m.max(d.translation_m),
            rotation_rad: worst.rotation_rad.max(d.rotation_rad),
        }))
    }

    /// Root mean square of the deviations.
    pub fn rms_left_out(&self) -> Option<Deviation> {
        let all = self.leave_one_out.as_ref()?;
        let mean = |part: &dyn Fn(&Deviation) -> f64| {
            (all.iter().map(|d| part(d).powi(2)).sum::<f64>() / all.len() as f64).sqrt()
        };
        Some(Deviation {
            translation_m: mean(&|d| d.translation_m),
            rotation_rad: mean(&|d| d.rotation_rad),
        })
    }
}

/// Estimates the error of `refinement`, which saw `observed` of the configurations of `work`.
pub(crate) fn estimate(
    work: &mut Work<'_>,
    refinement: &Refinement,
    observed: &[RefineView<'_>],
) -> ErrorEstimate {
    let pose = refinement.camera_from_base;
    let workspace_in_base = workspace(work);
    let mut covariance = refinement.covariance;
    let left_out = leave_one_out(work, observed, refinement);
    if let Some(ends) = &left_out {
        covariance += jackknife(&deltas(&pose, ends));
    }
    let sides = refinement
        .views
        .iter()
        .any(|view| view.outline_px.is_some())
        .then(|| one_sided(work, observed, refinement));
    covariance += match &sides {
        // The answer lies between the two, and either may be the better one.
        Some([surfaces, outlines]) => {
            let half = 0.5 * surfaces.camera_from_base.local(&outlines.camera_from_base);
            half * half.transpose()
        }
        None => Matrix6::from_diagonal(&ONE_KIND_SIGMA.map(|sigma| sigma * sigma)),
    };
    let between = |a: &Transform<Camera, Base>, b: &Start| {
        between(a, &b.camera_from_base, &workspace_in_base)
    };
    let joint_sigma_rad = joint_sigma(refinement, left_out.as_deref(), sides.as_ref());
    let to_optical = to_optical(work);
    ErrorEstimate {
        expected: expected(&covariance, &pose, &workspace_in_base),
        covariance: to_optical * covariance * to_optical.transpose(),
        leave_one_out: left_out.map(|ends| ends.iter().map(|end| between(&pose, end)).collect()),
        disagreement: sides.map(|[a, b]| between(&a.camera_from_base, &b)),
        workspace_in_base,
        joint_sigma_rad,
    }
}

/// Deviation of an answer from one kind of evidence alone, along each axis, m and rad: what surfaces
/// alone were off by on the LBR Med7 recording (15 mm and 1 degree in all).
const ONE_KIND_SIGMA: Vector6<f64> = Vector6::new(0.009, 0.009, 0.009, 0.01, 0.01, 0.01);

/// What surfaces alone and outlines alone make of `refinement`, with joints as likely to be off.
fn one_sided(
    work: &mut Work<'_>,
    observed: &[RefineView<'_>],
    refinement: &Refinement,
) -> [Start; 2] {
    [Trust::Surfaces, Trust::Outlines].map(|trust| {
        let joint_prior = JointPrior::Known { rad: refinement.joint_prior_rad };
        let options = RefineOptions { trust, joint_prior, ..ONE_SIDED };
        let (arm, rasters) = (&work.session.arm, &mut work.rasters);
        let start = &refinement.end();
        eyebolt_registration::refine(arm, observed, rasters, start, &options).end()
    })
}

/// Middle of where the end-effector was over all configurations.
fn workspace(work: &Work<'_>) -> Point3<f64> {
    let tip =
        |index: &usize| work.session.configurations[*index].base_from_end_effector.translation_m();
    let tips: Vec<Vector3<f64>> = work.indices.iter().map(tip).collect();
    Point3::from(tips.iter().sum::<Vector3<f64>>() / tips.len().max(1) as f64)
}

/// Refines on from `refinement` without each of the views in turn; `None` with fewer than three.
fn leave_one_out(
    work: &mut Work<'_>,
    observed: &[RefineView<'_>],
    refinement: &Refinement,
) -> Option<Vec<Start>> {
    if observed.len() < 3 {
        return None;
    }
    let arm = &work.session.arm;
    let joint_prior = JointPrior::Known { rad: refinement.joint_prior_rad };
    let options = RefineOptions { joint_prior, ..LEAVE_ONE_OUT };
    let start = &refinement.end();
    let ends = (0..observed.len()).map(|left_out| {
        let kept: Vec<RefineView<'_>> = observed
            .iter()
            .enumerate()
            .filter(|(index, _)| *index != left_out)
            .map(|(_, view)| view.clone())
            .collect();
        let rasters = &mut work.rasters[..kept.len()];
        eyebolt_registration::refine(arm, &kept, rasters, start, &options).end()
    });
    Some(ends.collect())
}

fn deltas(pose: &Transform<Camera, Base>, ends: &[Start]) -> Vec<Vector6<f64>> {
    ends.iter().map(|end| pose.local(&end.camera_from_base)).collect()
}

/// Jackknife covariance (Efron and Stein, Annals of Statistics 1981) of an answer from `deltas`, what
/// it changes by with each part left out.
fn jackknife<const N: usize>(deltas: &[SVector<f64, N>]) -> SMatrix<f64, N, N> {
    let count = deltas.len() as f64;
    let mean = deltas.iter().sum::<SVector<f64, N>>() / count;
    let scatter = deltas.iter().map(|d| (d - mean) * (d - mean).transpose());
    scatter.sum::<SMatrix<f64, N, N>>() * ((count - 1.0) / count)
}

/// Standard deviations of the joints' offsets, from the same sources as the pose's.
fn joint_sigma(
    refinement: &Refinement,
    left_out: Option<&[Start]>,
    sides: Option<&[Start; 2]>,
) -> [f64; MOST_JOINTS] {
    let offsets = |end: &Start| SVector::from(end.joint_offsets.rad);
    let mut variance = SVector::from(refinement.joint_sigma_rad).map(|sigma| sigma * sigma);
    if let Some(ends) = left_out {
        let offsets: Vec<_> = ends.iter().map(offsets).collect();
        variance += jackknife(&offsets).diagonal();
    }
    if let Some([surfaces, outlines]) = sides {
        variance += (offsets(surfaces) - offsets(outlines)).map(|apart| (0.5 * apart).powi(2));
    }
    variance.map(f64::sqrt).into()
}

fn between(
    a: &Transform<Camera, Base>,
    b: &Transform<Camera, Base>,
    at_in_base: &Point3<f64>,
) -> Deviation {
    Deviation {
        translation_m: (a.point(at_in_base) - b.point(at_in_base)).norm(),
        rotation_rad: a.rotation().angle_to(&b.rotation()),
    }
}

/// Root mean square of the errors that `covariance` lets one expect.
fn expected(
    covariance: &Matrix6<f64>,
    pose: &Transform<Camera, Base>,
    at_in_base: &Point3<f64>,
) -> Deviation {
    // A point of the base moves by the translation and by the rotation about the base's origin.
    let arm = pose.direction(&at_in_base.coords);
    let mut by_pose = nalgebra::SMatrix::<f64, 3, 6>::zeros();
    by_pose.fixed_view_mut::<3, 3>(0, 0).copy_from(&Matrix3::identity());
    by_pose.fixed_view_mut::<3, 3>(0, 3).copy_from(&-arm.cross_matrix());
    let point = by_pose * covariance * by_pose.transpose();
    let rotation = covariance.fixed_view::<3, 3>(3, 3).trace();
    Deviation { translation_m: point.trace().sqrt(), rotation_rad: rotation.sqrt() }
}

/// Turns covariances from the session's camera frame to the optical one.
fn to_optical(work: &Work<'_>) -> Matrix6<f64> {
    let turn = work.session.optical_from_camera.rotation().to_rotation_matrix();
    let mut both = Matrix6::zeros();
    both.fixed_view_mut::<3, 3>(0, 0).copy_from(turn.matrix());
    both.fixed_view_mut::<3, 3>(3, 3).copy_from(turn.matrix());
    both
}
