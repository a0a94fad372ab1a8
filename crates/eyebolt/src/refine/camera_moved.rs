//! Whether the camera moved between two configurations.

use super::workspace::Workspace;
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::{RefineView, Refinement, change_point};
use nalgebra::Matrix6;

/// The camera moved between two configurations of the recording.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraMoved {
    /// The last configuration before it did, of the observations.
    pub before: usize,
    /// The first one after.
    pub after: usize,
    /// Where the base was before, in the observations' own camera frame.
    pub earlier_camera_from_base: Transform<Camera, Base>,
    /// And where it was after.
    pub later_camera_from_base: Transform<Camera, Base>,
}

/// Two configurations tell a pose, though not how sure it is.
const LEAST_VIEWS: usize = 2;
/// How much better two poses have to explain the views than one to be looked at. Without a bump
/// correlated errors make it 10, and 50 at most on recordings of real arms; a bump that matters, hundreds.
const SCREENED: f64 = 20.0;
/// And how many times better than after the exchange of any two views. Of a bump it is 1.5 to 2.5 times;
/// errors of single views do not care about time, and some exchange makes it better.
const TIMELY: f64 = 1.2;
/// The difference of the two poses in squared standard deviations, for each of its six parts: sandwich
/// covariances of few views are too small by several times.
const SIGNIFICANT: f64 = 25.0;

/// A change of the camera's pose that is beyond doubt.
pub(super) struct Change<'a> {
    pub moved: CameraMoved,
    /// What the views after it come to alone, and what was seen in them.
    pub later: Refinement,
    pub seen: Vec<RefineView<'a>>,
    /// How many views there are before it.
    pub before: usize,
}

/// The change of pose among the views of `work`, if there is one, of which `refinement` says what they
/// come to together, and `seen` what was seen.
pub(super) fn find_change<'a>(
    work: &mut Workspace<'a, '_>,
    refinement: &Refinement,
    seen: &[RefineView<'a>],
) -> Option<Change<'a>> {
    let arm = &work.observations.arm;
    let change = change_point(arm, seen, &mut work.rasters, refinement, LEAST_VIEWS)?;
    tracing::debug!(?change, "where the camera most likely moved, if it did");
    if change.statistic < SCREENED.max(TIMELY * change.exchanged) {
        return None;
    }
    let (before, count) = (change.before, work.indices.len());
    let (earlier, _) = work.refine_some(0..before, &refinement.end());
    let (later, seen) = work.refine_some(before..count, &refinement.end());
    let apart = earlier.camera_from_base.local(&later.camera_from_base);
    let covariance: Matrix6<f64> = earlier.covariance + later.covariance;
    let squares = apart.dot(&(covariance.try_inverse()? * apart)) / 6.0;
    tracing::debug!(squares, ?apart, "how far the poses before and after are apart");
    let moved = CameraMoved {
        before: work.indices[before - 1],
        after: work.indices[before],
        earlier_camera_from_base: earlier.camera_from_base,
        later_camera_from_base: later.camera_from_base,
    };
    (squares > SIGNIFICANT).then_some(Change { moved, later, seen, before })
}
