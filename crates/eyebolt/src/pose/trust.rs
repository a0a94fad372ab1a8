//! How far to trust the pose of an end-effector.

use super::comparison::Comparison;
use super::contest::Contest;
use super::judged::Judged;
use super::observed::Observed;
use eyebolt_geometry::{Camera, EndEffector, Transform};
use eyebolt_registration::{Errors, StopReason, clustered_covariance};
use nalgebra::{Matrix6, Point3};
use std::fmt;

/// How far off a pose is likely to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExpectedError {
    /// Of the end-effector frame's origin, root mean square, millimetres.
    pub translation_mm: f64,
    /// Of its rotation, root mean square, degrees.
    pub rotation_deg: f64,
}

/// Another pose that was held against the answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rival {
    /// How far it is from the answer, by the turn that cannot be seen which is nearest, metres and radians.
    pub apart: (f64, f64),
    /// Pose of the end-effector.
    pub camera_from_end_effector: Transform<Camera, EndEffector>,
    /// With its links in which of the postures.
    pub opening: usize,
    /// What the frame says of the answer against it.
    pub comparison: Comparison,
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
    /// Too little of the posed shape shows: by chance it fits to anything that is small.
    Hidden {
        /// Share of its pixels that shows.
        share: f64,
    },
    /// A smooth surface explains what was seen better than the shape does: it is a part of something else.
    Smooth,
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
            Self::Hidden { share } => {
                write!(f, "only {:.0} % of the shape can be seen", percent(share))
            }
            Self::Smooth => write!(
                f,
                "a smooth surface explains what was seen better than the shape does: it is a part of \
                 something else"
            ),
            Self::SeenThrough { share } => {
                write!(f, "the camera saw through {:.0} % of the shape", percent(share))
            }
        }
    }
}

/// By how many standard deviations the costs of two poses have to differ for one to be the better one. Of the simulated frames of
/// `examples/pose_truth.rs` right answers are 1.5 to 12 from a half turn, and wrong ones hardly ever more than 1.5.
const TELLING: f64 = 1.7;
/// Poses nearer to each other are one, of which it is not known exactly where it is, metres and radians.
const NEAR_M: f64 = 0.02;
const NEAR_RAD: f64 = 0.25;
/// By how much depth is biased, alike over parts of an end-effector, of so much of its extent: at the camera, and for each
/// square metre of distance (as the noise of triangulation grows), metres.
const BIAS_M: f64 = 5e-4;
const BIAS_PER_SQUARE_METRE_M: f64 = 1e-3;
const PARTS: f64 = 0.25;
/// Errors go together over as many pixels as residuals show: patches that are so many times as large along an edge are tried, too.
const LARGER_PATCHES: [u32; 2] = [2, 4];
/// Least share of the end-effector's pixels on the shape, and most of the shape's that the camera saw through.
const LEAST_EXPLAINED: f64 = 0.5;
const MOST_SEEN_THROUGH: f64 = 0.2;
/// Least share of the posed shape that shows: where the frame says clearly that it is no smooth surface, and where it does not,
/// since by chance a shape fits to anything that is small.
const LEAST_SHOWN: [f64; 2] = [0.25, 0.45];
/// By so many standard deviations it says so clearly. Of some 600 poses that were tried in semi-real frames, nine
/// in ten of the right ones have 1.9 standard deviations and more; none of those with 1.7 that were somewhere else explained 55 % of
/// what was seen and was seen through by less than 27 %.
pub(super) const CLEARLY: f64 = 1.7;
/// By so many a smooth surface is better: three in a hundred of the right poses, and three in four of those elsewhere.
const SMOOTH: f64 = 1.2;
/// Most of the outline beyond which the surface goes on: where the end-effector is mounted.
const MOST_GOES_ON: f64 = 0.45;
/// Shapes, intrinsics and simplified meshes are not better than this, metres and radians.
const FLOOR_M: f64 = 0.0003;
const FLOOR_RAD: f64 = 0.001;

/// Errors as the residuals have them, those of a patch of the image together, be it small or large; biases of the camera, which do not show; and
/// what poses nearby that fit as well are apart.
fn expected_error(contest: &Contest<'_>, best: &Judged, rivals: &[Rival]) -> Option<ExpectedError> {
    let fit = &best.fit;
    if fit.stop == StopReason::Underdetermined {
        return None;
    }
    let Contest { shape, observed, .. } = contest;
    let bias_m = BIAS_M + BIAS_PER_SQUARE_METRE_M * observed.middle().z.powi(2);
    let parts = regions(observed, PARTS * shape.extent_m());
    let biased = covariance(contest, best, Errors::Alike(&parts, bias_m))?;
    let covariance = as_seen(contest, best)? + biased;
    let trace = |first: usize| (first..first + 3).map(|at| covariance[(at, at)]).sum::<f64>();
    let near = rivals.iter().filter(|rival| rival.is_near() && rival.is_as_good());
    let farthest = near
        .map(|rival| rival.apart)
        .fold((0.0, 0.0), |a: (f64, f64), b| (a.0.max(b.0), a.1.max(b.1)));
    let root = |variance: f64, floor: f64| (variance + floor * floor).max(0.0).sqrt();
    Some(ExpectedError {
        translation_mm: 1e3 * root(trace(0) + (0.5 * farthest.0).powi(2), FLOOR_M),
        rotation_deg: root(trace(3) + (0.5 * farthest.1).powi(2), FLOOR_RAD).to_degrees(),
    })
}

/// The largest covariance that residuals show; `None` where the smallest patches show none.
fn as_seen(contest: &Contest<'_>, best: &Judged) -> Option<Matrix6<f64>> {
    let extent_m = contest.shape.extent_m();
    let size = |covariance: &Matrix6<f64>| {
        let [shift, turn] = [0, 3].map(|at| covariance.fixed_view::<3, 3>(at, at).trace());
        shift + extent_m.powi(2) * turn
    };
    let by = |times: u32| {
        let patches = contest.observed.patches(times);
        covariance(contest, best, Errors::AsSeen(&patches))
    };
    let smallest = by(1)?;
    let larger = LARGER_PATCHES.into_iter().filter_map(by);
    larger.chain([smallest]).max_by(|a, b| size(a).total_cmp(&size(b)))
}

fn covariance(contest: &Contest<'_>, best: &Judged, errors: Errors<'_>) -> Option<Matrix6<f64>> {
    let fitted = (&contest.shape.model, contest.openings.get(best.opening)?);
    let points = &contest.observed.points;
    clustered_covariance(fitted, points, errors, &best.fit, &Contest::LAST)
}

/// Of each point, which square of that edge before the camera it is in.
fn regions(observed: &Observed, edge_m: f64) -> Vec<u32> {
    let edge = (edge_m / observed.middle().z) as f32;
    let of = |point: &Point3<f32>| {
        let [u, v] = [point.x, point.y].map(|of| (of / point.z / edge).floor() as i32 as u32);
        u.wrapping_mul(0x1_0001).wrapping_add(v)
    };
    observed.points.iter().map(of).collect()
}

impl Rival {
    /// Whether it explains the frame as well as the answer: the difference tells nothing.
    pub fn is_as_good(&self) -> bool {
        self.comparison.advantage < TELLING * self.comparison.deviation
    }

    /// Whether it is the same pose, but for an error.
    fn is_near(&self) -> bool {
        self.apart.0 < NEAR_M && self.apart.1 < NEAR_RAD
    }
}

/// How far off the best of a contest is likely to be, or why it should not be used.
pub(super) fn trust(
    contest: &Contest<'_>,
    best: &Judged,
    rivals: &[Rival],
    against_smooth: Option<Comparison>,
) -> (Option<ExpectedError>, Option<Refusal>) {
    let expected = expected_error(contest, best, rivals);
    let refusal = match expected {
        None => Some(Refusal::Underdetermined),
        Some(_) => refusal(best, rivals, against_smooth),
    };
    (expected, refusal)
}

fn refusal(best: &Judged, rivals: &[Rival], against_smooth: Option<Comparison>) -> Option<Refusal> {
    let support = best.support;
    let significance = against_smooth.as_ref().map_or(0.0, Comparison::significance);
    if support.explained < LEAST_EXPLAINED {
        return Some(Refusal::Unexplained { share: support.explained });
    }
    if support.seen_through > MOST_SEEN_THROUGH {
        return Some(Refusal::SeenThrough { share: support.seen_through });
    }
    if significance < -SMOOTH {
        return Some(Refusal::Smooth);
    }
    let [if_clear, else_] = LEAST_SHOWN;
    if support.shown < if significance > CLEARLY { if_clear } else { else_ } {
        return Some(Refusal::Hidden { share: support.shown });
    }
    if support.goes_on > MOST_GOES_ON {
        return Some(Refusal::GoesOn { share: support.goes_on });
    }
    let another = rivals.iter().find(|rival| rival.is_as_good() && !rival.is_near());
    another.map(|other| Refusal::Ambiguous { apart_deg: other.apart.1.to_degrees() })
}
