//! What one view says against an answer that is known: of a shift of the pose, and of the joints.

use super::clusters::clusters;
use super::gather::{ViewFactors, deviations, gather};
use super::gauss_newton::final_scales;
use super::outcome::ViewFit;
use super::start::{OffsetDeviations, RefineView, Start, Trust};
use super::summary::view_fit;
use super::system::{Matrix, Sum, System, Weights};
use crate::arm::{ArmModel, MOST_JOINTS};
use crate::evidence::{KINDS, Reach};
use crate::unknowns::{
    EVIDENCE_KINDS, FIRST_JOINT, FIRST_NUISANCE, POSE, State, UNKNOWNS, Unknowns,
};
use eyebolt_render::Raster;
use nalgebra::{Matrix6, SMatrix, SVector, Vector6};
use std::slice::{from_mut, from_ref};

/// Shift of the pose, translation (m) and rotation (rad) as [`retract`] has them, then how much farther each
/// joint stands than known (rad).
///
/// [`retract`]: eyebolt_geometry::Transform::retract
pub const SHIFTS: usize = POSE + MOST_JOINTS;

/// How far the pose and each joint may be from what is known, as standard deviations, while a view is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShiftDeviations {
    /// Along each axis, metres.
    pub translation_m: f64,
    /// About each axis, radians.
    pub rotation_rad: f64,
    /// Of each joint, radians.
    pub joint_rad: f64,
}

/// What one view says of the shifts from what is known, as the quadratic that its negative logarithm of the
/// likelihood is about where it is least: `x^T information x / 2 - vector^T x`.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewEvidence {
    /// By the noise model of the refinement; what else is unknown of a view is profiled out.
    pub information: SMatrix<f64, SHIFTS, SHIFTS>,
    /// `information` times the shifts that fit best.
    pub vector: SVector<f64, SHIFTS>,
    /// Where the view alone, with the deviations allowed, has everything.
    pub end: Start,
    /// How well it fits there.
    pub fit: ViewFit,
}

impl ViewEvidence {
    /// That of the pose alone, each joint within `joint_rad` of where it is known to be.
    pub fn of_pose(&self, joint_rad: f64) -> Option<(Matrix6<f64>, Vector6<f64>)> {
        let mut information = self.information;
        for joint in POSE..SHIFTS {
            information[(joint, joint)] += joint_rad.powi(-2);
        }
        let joints = information.fixed_view::<MOST_JOINTS, MOST_JOINTS>(POSE, POSE).into_owned();
        let across = information.fixed_view::<POSE, MOST_JOINTS>(0, POSE).into_owned();
        let gain = across * joints.try_inverse()?;
        let own = information.fixed_view::<POSE, POSE>(0, 0).into_owned();
        let rest = self.vector.fixed_rows::<MOST_JOINTS>(POSE);
        let vector = self.vector.fixed_rows::<POSE>(0) - gain * rest;
        let left = own - gain * across.transpose();
        Some(((left + left.transpose()) * 0.5, vector))
    }
}

/// By how much the depth's scale may be another than known, and by how many pixels an outline too wide.
const NUISANCES: [f64; EVIDENCE_KINDS] = [0.005, 1.0];
/// Of a kernel's scale, from one step to the next.
const SHRINK: f64 = 0.6;

/// Looks at `view`, from the state `at`, for how it differs from what is `known`; `steps` Gauss-Newton steps.
/// `raster` is drawn anew.
///
/// `None` where the view determines nothing, not even with what is known.
pub fn view_evidence(
    arm: &ArmModel,
    view: &RefineView<'_>,
    raster: &mut Raster,
    (known, at): (&Start, &Start),
    allowed: &ShiftDeviations,
    (steps, reach): (usize, Reach),
) -> Option<ViewEvidence> {
    let (views, rasters) = (from_ref(view), from_mut(raster));
    let clusters = clusters(views);
    let mut gathered = vec![ViewFactors::default()];
    let (known, mut state) = (State::from(*known), State::from(*at));
    let mut scales = KINDS.map(|kind| kind.first_scale(reach));
    gather(arm, views, rasters, &state, &mut gathered);
    let own = own_deviations(allowed);
    for _ in 0..steps {
        let weights =
            Weights { scales, deviations: deviations(&gathered, &scales), trust: Trust::All };
        let mut sum = System::new(&gathered, &clusters, &weights, Matrix::Reweighted).total();
        add_priors(&mut sum, &away(&known, &state), &own);
        state = state.stepped(&sum.solve(1e-6)?);
        gather(arm, views, rasters, &state, &mut gathered);
        for (scale, least) in scales.iter_mut().zip(final_scales(&weights.deviations)) {
            *scale = (SHRINK * *scale).max(least);
        }
    }
    let weights = Weights { scales, deviations: deviations(&gathered, &scales), trust: Trust::All };
    let sum = System::new(&gathered, &clusters, &weights, Matrix::Reweighted).total();
    let vector = sum.information * away(&known, &state) - sum.gradient;
    let (information, vector) = profiled(&sum.information, &vector, &own)?;
    let fit = view_fit(&gathered[0], &weights.deviations);
    Some(ViewEvidence { information, vector, end: state.into(), fit })
}

fn own_deviations(allowed: &ShiftDeviations) -> Unknowns {
    let mut own = Unknowns::zeros();
    let ShiftDeviations { translation_m: t, rotation_rad: r, joint_rad } = *allowed;
    own.fixed_rows_mut::<POSE>(0).copy_from_slice(&[t, t, t, r, r, r]);
    own.fixed_rows_mut::<EVIDENCE_KINDS>(FIRST_NUISANCE).copy_from_slice(&NUISANCES);
    let described =
        OffsetDeviations { joints_rad: [joint_rad; MOST_JOINTS], ..OffsetDeviations::NONE };
    for (place, deviation) in described.numbers().into_iter().enumerate() {
        own[FIRST_JOINT + place] = deviation;
    }
    own
}

/// How far `state` is from what is `known`.
fn away(known: &State, state: &State) -> Unknowns {
    let mut away = Unknowns::zeros();
    let pose = known.camera_from_base.local(&state.camera_from_base);
    away.fixed_rows_mut::<POSE>(0).copy_from(&pose);
    for kind in 0..EVIDENCE_KINDS {
        away[FIRST_NUISANCE + kind] = state.nuisances[kind] - known.nuisances[kind];
    }
    let offsets = state.offsets().into_iter().zip(known.offsets());
    for (place, (offset, known)) in offsets.enumerate() {
        away[FIRST_JOINT + place] = offset - known;
    }
    away
}

fn add_priors(sum: &mut Sum, away: &Unknowns, own: &Unknowns) {
    for unknown in 0..UNKNOWNS {
        sum.add(&Unknowns::ith(unknown, 1.0), away[unknown], own[unknown].powi(-2));
    }
}

/// What remains of pose and joints when all else is profiled out.
fn profiled(
    information: &SMatrix<f64, UNKNOWNS, UNKNOWNS>,
    vector: &Unknowns,
    own: &Unknowns,
) -> Option<(SMatrix<f64, SHIFTS, SHIFTS>, SVector<f64, SHIFTS>)> {
    const REST: usize = UNKNOWNS - SHIFTS;
    let is_kept = |unknown: &usize| {
        *unknown < POSE || (FIRST_JOINT..FIRST_JOINT + MOST_JOINTS).contains(unknown)
    };
    let (kept, rest): (Vec<usize>, Vec<usize>) = (0..UNKNOWNS).partition(is_kept);
    let mut own_of_rest =
        SMatrix::<f64, REST, REST>::from_fn(|i, j| information[(rest[i], rest[j])]);
    for place in 0..REST {
        own_of_rest[(place, place)] += own[rest[place]].powi(-2);
    }
    let across = SMatrix::<f64, SHIFTS, REST>::from_fn(|i, j| information[(kept[i], rest[j])]);
    let gain = across * own_of_rest.try_inverse()?;
    let of_rest = SVector::<f64, REST>::from_fn(|i, _| vector[rest[i]]);
    let of_kept = SVector::<f64, SHIFTS>::from_fn(|i, _| vector[kept[i]]);
    let own_of_kept =
        SMatrix::<f64, SHIFTS, SHIFTS>::from_fn(|i, j| information[(kept[i], kept[j])]);
    let left = own_of_kept - gain * across.transpose();
    let vector = of_kept - gain * of_rest;
    let is_finite = left.iter().chain(vector.iter()).all(|v| v.is_finite());
    is_finite.then(|| ((left + left.transpose()) * 0.5, vector))
}
