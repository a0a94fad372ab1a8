//! How far off an answer is expected to be: ARCHITECTURE.md, (8) to (11).
//!
//! Three sources, each seen by another experiment: the scatter of the residuals (the sandwich
//! covariance of the refinement), what changes when configurations are left out (jackknife), and
//! what is wrong in every frame alike, which neither of these can see: it shows where the kinds
//! of evidence disagree.
//!
//! Offsets of joints are unknowns in all three. One that nothing determines is as uncertain as this
//! arm's offsets are large, and the pose is with it.

use super::deviation::Deviation;
use super::jackknife::{Jackknife, jackknife, without_parts};
use super::one_kind::{one_kind_each, spread};
use super::still_part::StillPart;
use crate::refine::Workspace;
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::{Doubt, MOST_JOINTS, RefineView, Refinement, Start, birge_ratio};
use nalgebra::{Matrix3, Matrix6, Point3, SMatrix, SVector, Vector3, Vector6};

/// An experiment that shows how far off an answer may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorSource {
    /// The scatter of the residuals: the sandwich covariance.
    Scatter,
    /// Leaving out single configurations: the jackknife.
    LeftOut,
    /// What single kinds of evidence would say alone.
    Disagreement,
    /// What lengths of links, the base and intrinsics may be off by that were taken at their word.
    Description,
    /// Allowed for what other kinds of evidence would have told, where there is only one.
    OneKind,
    /// Allowed for what leaving out single configurations would have told, where there are too few.
    FewConfigurations,
}

/// What one source adds to the expected error; parts add up in squares.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorPart {
    /// The source.
    pub source: ErrorSource,
    /// Root mean square error from it alone.
    pub expected: Deviation,
}

/// How far off an answer is expected to be.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorEstimate {
    /// Root mean square error to expect, of all sources together.
    pub expected: Deviation,
    /// The same of the camera's own position in the base frame, metres: `expected` is of points in the
    /// workspace, where the arm was seen.
    pub camera_position_m: f64,
    /// What each source adds.
    pub parts: Vec<ErrorPart>,
    /// Covariance of the answer, translation (m) then rotation (rad), in the answer's frame, as
    /// [`Transform::retract`] has them; all sources together.
    pub covariance: Matrix6<f64>,
    /// What each configuration changes when it is left out, in the order of those used; `None`
    /// with fewer than three of them.
    pub leave_one_out: Option<Vec<Deviation>>,
    /// The largest difference between the answers that single kinds of evidence would give; `None`
    /// where only one kind was seen.
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
        Some(all.iter().copied().fold(Deviation::default(), Deviation::larger))
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

/// Estimates the error of `refinement`, which saw `seen` of the configurations of `work`.
pub(crate) fn estimate(
    work: &mut Workspace<'_, '_>,
    refinement: &Refinement,
    seen: &[RefineView<'_>],
    how: Jackknife,
    still: Option<&StillPart>,
) -> ErrorEstimate {
    let pose = refinement.camera_from_base;
    let workspace_in_base = workspace(work);
    let without = without_parts(work, seen, refinement, how);
    let one_kind = one_kind_each(work, seen, refinement);
    let mut sources = vec![(ErrorSource::Scatter, refinement.covariance)];
    if let Some(without) = &without {
        sources.push((ErrorSource::LeftOut, jackknife(&deltas(&pose, &without.parts))));
    }
    let ratio = one_kind.as_ref().map(|alone| birge(refinement, alone));
    let doubts = by_doubts(&refinement.doubts);
    let base = still.map(|still| by_base(still, &pose, ratio.unwrap_or(1.0)));
    let base = base.unwrap_or_else(Matrix6::zeros);
    sources.push((ErrorSource::Description, doubts + base));
    sources.push(match ratio {
        Some(ratio) => (ErrorSource::Disagreement, by_disagreement(refinement, ratio)),
        None => {
            let variance = ONE_KIND_SIGMA.map(|sigma| sigma * sigma);
            (ErrorSource::OneKind, Matrix6::from_diagonal(&variance))
        }
    });
    if without.is_none() {
        let told: Matrix6<f64> = sources.iter().map(|(_, covariance)| covariance).sum();
        sources.push((ErrorSource::FewConfigurations, UNTOLD * told));
    }
    let covariance: Matrix6<f64> = sources.iter().map(|(_, covariance)| covariance).sum();
    let parts = sources.into_iter().map(|(source, covariance)| ErrorPart {
        source,
        expected: expected(&covariance, &pose, &workspace_in_base),
    });
    let between = |a: &Start, b: &Start| {
        Deviation::between(&a.camera_from_base, &b.camera_from_base, &workspace_in_base)
    };
    let end = refinement.end();
    let to_optical = to_optical(work);
    let camera_in_base = Point3::from(pose.inverse().translation_m());
    ErrorEstimate {
        camera_position_m: expected(&covariance, &pose, &camera_in_base).translation_m,
        expected: expected(&covariance, &pose, &workspace_in_base),
        parts: parts.collect(),
        covariance: to_optical * covariance * to_optical.transpose(),
        leave_one_out: without
            .as_ref()
            .map(|without| without.configurations.iter().map(|e| between(&end, e)).collect()),
        disagreement: one_kind.as_ref().map(|alone| {
            let pairs = alone
                .iter()
                .enumerate()
                .flat_map(|(i, a)| alone[i + 1..].iter().map(move |b| (a, b)));
            let apart = pairs.map(|(a, b)| between(&a.end(), &b.end()));
            apart.fold(Deviation::default(), Deviation::larger)
        }),
        workspace_in_base,
        joint_sigma_rad: joint_sigma(
            refinement,
            without.as_ref().map(|without| without.parts.as_slice()),
            one_kind.as_deref(),
        ),
    }
}

/// The estimate for a pose of which one kind of evidence alone tells, with so much covariance of its own, at a point
/// of the base frame; nothing else is known of it.
pub(crate) fn expected_at(
    pose: &Transform<Camera, Base>,
    scatter: Matrix6<f64>,
    workspace_in_base: &Point3<f64>,
) -> ErrorEstimate {
    let one_kind = Matrix6::from_diagonal(&ONE_KIND_SIGMA.map(|sigma| sigma * sigma));
    let covariance = scatter + one_kind;
    let part = |(source, covariance)| ErrorPart {
        source,
        expected: expected(&covariance, pose, workspace_in_base),
    };
    let camera_in_base = Point3::from(pose.inverse().translation_m());
    ErrorEstimate {
        expected: expected(&covariance, pose, workspace_in_base),
        camera_position_m: expected(&covariance, pose, &camera_in_base).translation_m,
        parts: [(ErrorSource::Scatter, scatter), (ErrorSource::OneKind, one_kind)]
            .map(part)
            .to_vec(),
        covariance,
        leave_one_out: None,
        disagreement: None,
        workspace_in_base: *workspace_in_base,
        joint_sigma_rad: [f64::INFINITY; MOST_JOINTS],
    }
}

/// What one or two configurations do not tell, as a part of the variance that they do: of 16 simulated sessions of
/// so few, rotations were off by up to three times as much as the rest lets one expect.
const UNTOLD: f64 = 3.0;

/// By how much single kinds of evidence disagree; infinite where that cannot be told.
fn birge(refinement: &Refinement, alone: &[Refinement]) -> f64 {
    let pose = &refinement.camera_from_base;
    let kinds: Vec<_> =
        alone.iter().map(|kind| (kind.information, pose.local(&kind.camera_from_base))).collect();
    birge_ratio(&kinds).unwrap_or(f64::INFINITY)
}

/// Covariance that the disagreement of single kinds of evidence lets one expect.
fn by_disagreement(refinement: &Refinement, birge: f64) -> Matrix6<f64> {
    let noise = refinement.information.try_inverse().filter(|_| birge.is_finite());
    noise.map_or(Matrix6::from_element(f64::INFINITY), |noise| noise * birge)
}

/// How likely a length or an intrinsic is to be off before anything is seen of it.
const OFF: f64 = 0.05;

/// Covariance from what may be off and was taken at its word: each shift as likely as the evidence for it
/// makes it (Bayesian model averaging; Hoeting et al., Statistical Science 1999). What is left of the disagreement of kinds once
/// they are allowed for is in the evidence already; all of it would be too much: a focal length that is off is why they disagree.
fn by_doubts(doubts: &[Doubt]) -> Matrix6<f64> {
    let each = doubts.iter().map(|doubt| {
        let odds = OFF / (1.0 - OFF) * doubt.log_evidence.exp();
        doubt.mean_square * (odds / (1.0 + odds)).min(1.0)
    });
    each.sum()
}

/// Covariance from a base that is not where the description has it: the answer is of the base.
fn by_base(still: &StillPart, pose: &Transform<Camera, Base>, birge: f64) -> Matrix6<f64> {
    let turn = pose.rotation().to_rotation_matrix();
    let mut covariance = Matrix6::zeros();
    let in_camera = turn.matrix() * still.mean_square(birge) * turn.matrix().transpose();
    covariance.fixed_view_mut::<3, 3>(0, 0).copy_from(&in_camera);
    covariance
}

/// Standard deviation of an answer from one kind of evidence alone, along each axis, m and rad: what
/// surfaces alone were off by on the LBR Med7 recording (15 mm and 1 degree in all).
const ONE_KIND_SIGMA: Vector6<f64> = Vector6::new(0.009, 0.009, 0.009, 0.01, 0.01, 0.01);

/// Middle of where the end-effector was over all configurations.
fn workspace(work: &Workspace<'_, '_>) -> Point3<f64> {
    let tip = |index: &usize| {
        work.observations.configurations[*index].base_from_end_effector.translation_m()
    };
    let tips: Vec<Vector3<f64>> = work.indices.iter().map(tip).collect();
    Point3::from(tips.iter().sum::<Vector3<f64>>() / tips.len().max(1) as f64)
}

fn deltas(pose: &Transform<Camera, Base>, ends: &[Start]) -> Vec<Vector6<f64>> {
    ends.iter().map(|end| pose.local(&end.camera_from_base)).collect()
}

/// Standard deviations of the joints' offsets, from the same sources as the pose's.
fn joint_sigma(
    refinement: &Refinement,
    left_out: Option<&[Start]>,
    one_kind: Option<&[Refinement]>,
) -> [f64; MOST_JOINTS] {
    let offsets = |ends: &[Start]| -> Vec<SVector<f64, MOST_JOINTS>> {
        ends.iter().map(|end| SVector::from(end.joint_offsets.rad)).collect()
    };
    let mut variance = SVector::from(refinement.joint_sigma_rad).map(|sigma| sigma * sigma);
    if let Some(ends) = left_out {
        variance += jackknife(&offsets(ends)).diagonal();
    }
    if let Some(alone) = one_kind {
        let ends: Vec<Start> = alone.iter().map(Refinement::end).collect();
        variance += spread(&offsets(&ends)).diagonal();
    }
    variance.map(f64::sqrt).into()
}

/// Root mean square of the errors that `covariance` lets one expect.
pub(crate) fn expected(
    covariance: &Matrix6<f64>,
    pose: &Transform<Camera, Base>,
    at_in_base: &Point3<f64>,
) -> Deviation {
    let point = covariance_at(covariance, pose, at_in_base);
    let rotation = covariance.fixed_view::<3, 3>(3, 3).trace();
    Deviation { translation_m: point.trace().sqrt(), rotation_rad: rotation.sqrt() }
}

/// Covariance of where a point of the base is, by the `covariance` of its `pose`, both along the camera's
/// axes.
pub fn covariance_at(
    covariance: &Matrix6<f64>,
    pose: &Transform<Camera, Base>,
    at_in_base: &Point3<f64>,
) -> Matrix3<f64> {
    // The point moves by the translation and by the rotation about the base's origin.
    let arm = pose.direction(&at_in_base.coords);
    let mut by_pose = SMatrix::<f64, 3, 6>::zeros();
    by_pose.fixed_view_mut::<3, 3>(0, 0).copy_from(&Matrix3::identity());
    by_pose.fixed_view_mut::<3, 3>(0, 3).copy_from(&-arm.cross_matrix());
    by_pose * covariance * by_pose.transpose()
}

/// Turns covariances from the observations' camera frame to the optical one.
fn to_optical(work: &Workspace<'_, '_>) -> Matrix6<f64> {
    let turn = work.observations.optical_from_camera.rotation().to_rotation_matrix();
    let mut both = Matrix6::zeros();
    both.fixed_view_mut::<3, 3>(0, 0).copy_from(turn.matrix());
    both.fixed_view_mut::<3, 3>(3, 3).copy_from(turn.matrix());
    both
}

#[cfg(test)]
mod tests;
