//! How far to trust the pose of an end-effector.

use super::judged::Judged;
use super::observed::Observed;
use eyebolt_geometry::{Camera, EndEffector, Transform};
use eyebolt_registration::{Icp, StopReason};
use std::fmt;

/// How far off a pose is likely to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExpectedError {
    /// Of the end-effector frame's origin, root mean square, millimetres.
    pub translation_mm: f64,
    /// Of its rotation, root mean square, degrees.
    pub rotation_deg: f64,
}

/// Why a pose should not be used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refusal {
    /// The points do not say all of it.
    Underdetermined,
    /// Another pose explains the frame as well.
    Ambiguous {
        /// How far it is turned from the first, degrees.
        apart_deg: f64,
    },
    /// The shape explains too little of what was seen of the end-effector.
    Unexplained {
        /// Share of its pixels on the posed shape.
        share: f64,
    },
    /// What was seen goes on beyond the posed shape: it is a part of something else.
    GoesOn {
        /// Share of its outline.
        share: f64,
    },
    /// The camera saw through the posed shape.
    SeenThrough {
        /// Share of its pixels.
        share: f64,
    },
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let percent = |share: &f64| 100.0 * share;
        match self {
            Self::Underdetermined => write!(f, "what is in view does not tell the whole pose"),
            Self::Ambiguous { apart_deg } => write!(
                f,
                "a pose turned by {apart_deg:.0} degrees explains the frame as well; joint states or \
                 another view tell which"
            ),
            Self::Unexplained { share } => write!(
                f,
                "only {:.0} % of what was seen of the end-effector is on its shape; is it the one of the \
                 description?",
                percent(share)
            ),
            Self::GoesOn { share } => write!(
                f,
                "beyond {:.0} % of the shape's outline the surface goes on: it is a part of something else",
                percent(share)
            ),
            Self::SeenThrough { share } => {
                write!(f, "the camera saw through {:.0} % of the shape", percent(share))
            }
        }
    }
}

/// Errors of depth are shared by about so many neighbouring pixels: windows of stereo and structured light,
/// seen by an end-effector of a hundred pixels across.
const CORRELATED_PX: f64 = 60.0;
/// By how much the logarithm of the likelihood has to differ for a pose to be the better one.
const TELLING: f64 = 3.0;
/// Least share of the end-effector's pixels on the shape, and most of the shape's that the camera saw through.
const LEAST_EXPLAINED: f64 = 0.55;
const MOST_SEEN_THROUGH: f64 = 0.2;
/// Most of the outline beyond which the surface goes on: where the end-effector is mounted.
const MOST_GOES_ON: f64 = 0.2;
/// Shapes, intrinsics and simplified meshes are not better than this, metres and radians.
const FLOOR_M: f64 = 0.0003;
const FLOOR_RAD: f64 = 0.001;

/// Errors as the residuals have them, of points that are correlated in the image.
pub(super) fn expected_error(observed: &Observed, fit: &Icp) -> Option<ExpectedError> {
    if fit.stop == StopReason::Underdetermined {
        return None;
    }
    let taken = observed.pixels as f64 / observed.points.len().max(1) as f64;
    let per_point = (CORRELATED_PX / taken).max(1.0);
    let covariance = fit.information.try_inverse()? * fit.deviation_m.powi(2) * per_point;
    let trace = |first: usize| (first..first + 3).map(|at| covariance[(at, at)]).sum::<f64>();
    let root = |variance: f64, floor: f64| (variance + floor * floor).max(0.0).sqrt();
    Some(ExpectedError {
        translation_mm: 1e3 * root(trace(0), FLOOR_M),
        rotation_deg: root(trace(3), FLOOR_RAD).to_degrees(),
    })
}

/// Whether `other` explains the frame as well as `best`: the difference of their costs, as a logarithm of
/// likelihoods of pixels that are not independent, tells nothing.
pub(super) fn is_as_good(best: &Judged, other: &Judged) -> bool {
    // A cost of 1 is a residual of three standard deviations of what the judge goes by, which is 1.5 of the
    // noise's.
    const PER_COST: f64 = 0.5 * 9.0;
    let pixels = best.support.pixels.max(other.support.pixels) as f64 / CORRELATED_PX.sqrt();
    PER_COST * pixels * (other.support.cost - best.support.cost) < TELLING
}

pub(super) fn refusal(
    observed: &Observed,
    best: &Judged,
    alternatives: &[Transform<Camera, EndEffector>],
) -> Option<Refusal> {
    if expected_error(observed, &best.fit).is_none() {
        return Some(Refusal::Underdetermined);
    }
    let support = best.support;
    if support.explained < LEAST_EXPLAINED {
        return Some(Refusal::Unexplained { share: support.explained });
    }
    if support.seen_through > MOST_SEEN_THROUGH {
        return Some(Refusal::SeenThrough { share: support.seen_through });
    }
    if support.goes_on > MOST_GOES_ON {
        return Some(Refusal::GoesOn { share: support.goes_on });
    }
    alternatives.first().map(|other| {
        let rotation = best.fit.camera_from_base.rotation();
        let apart_deg = rotation.angle_to(&other.rotation()).to_degrees();
        Refusal::Ambiguous { apart_deg }
    })
}
