//! Where refinement starts: the answers of the closed-form solvers, each on the poses that agree with it.

use super::poses::{HandEye, PosePair, View};
use super::solver::{HandEyeError, Solver, solve};
use crate::frames::Marker;
use eyebolt_geometry::{Camera, CoordinateFrame, Transform};

/// The other pose of a flat marker is in question where it fits less than this many times worse.
const AMBIGUOUS: f64 = 2.0;
/// A view that is this many times as far from where it should be as the middle one does not take part.
const OUTLIER: f64 = 6.0;
/// What is always near enough, radians and shares of the distance: exact data have no middle to speak of.
const NEAR: f64 = 1e-3;
const ROUNDS: usize = 3;

/// The answer of one solver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start<Root: CoordinateFrame, Carrier: CoordinateFrame> {
    /// The solver.
    pub solver: Solver,
    /// What it says, or why nothing.
    pub answer: Result<HandEye<Root, Carrier>, HandEyeError>,
    /// How many views took part.
    pub used: usize,
}

/// The answers of all solvers.
///
/// Views of which one cannot tell in which of two ways the marker is turned are taken as the others have
/// them; views that do not agree with the others are left out.
pub fn starts<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    views: &[View<Root, Carrier>],
) -> Vec<Start<Root, Carrier>> {
    let pair = |view: &View<Root, Carrier>| {
        let pose = view.poses.first()?;
        Some(PosePair {
            root_from_carrier: view.root_from_carrier,
            camera_from_marker: pose.camera_from_marker,
        })
    };
    let sure: Vec<_> = views.iter().filter(|view| !is_ambiguous(view)).filter_map(pair).collect();
    let all: Vec<_> = views.iter().filter_map(pair).collect();
    let each = Solver::ALL.into_iter();
    each.map(|solver| {
        let first = solve(solver, &sure);
        let (answer, pairs) = match first {
            Ok(answer) => (Ok(answer), &sure),
            Err(_) => (solve(solver, &all), &all),
        };
        let start = Start { solver, answer, used: pairs.len() };
        (0..ROUNDS).fold(start, |start, _| agreed(start, views))
    })
    .collect()
}

fn is_ambiguous<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    view: &View<Root, Carrier>,
) -> bool {
    match view.poses.as_slice() {
        [first, second, ..] => second.rms_px < AMBIGUOUS * first.rms_px,
        _ => false,
    }
}

/// The solver's answer with the poses that agree with `start`.
fn agreed<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    start: Start<Root, Carrier>,
    views: &[View<Root, Carrier>],
) -> Start<Root, Carrier> {
    let Ok(answer) = start.answer else { return start };
    let nearest = |view: &View<Root, Carrier>| {
        let expected = answer.camera_from_marker(&view.root_from_carrier);
        let off = view.poses.iter().map(|pose| {
            let seen = pose.camera_from_marker;
            let pair =
                PosePair { root_from_carrier: view.root_from_carrier, camera_from_marker: seen };
            (deviation(&seen, &expected), pair)
        });
        off.min_by(|a, b| a.0.total_cmp(&b.0))
    };
    let nearest: Vec<_> = views.iter().filter_map(nearest).collect();
    let mut sizes: Vec<f64> = nearest.iter().map(|(off, _)| *off).collect();
    sizes.sort_by(f64::total_cmp);
    let middle = sizes.get(sizes.len() / 2).copied().unwrap_or_default();
    let near = nearest.into_iter().filter(|(off, _)| *off <= (OUTLIER * middle).max(NEAR));
    let pairs: Vec<_> = near.map(|(_, pair)| pair).collect();
    match solve(start.solver, &pairs) {
        Ok(answer) => Start { answer: Ok(answer), used: pairs.len(), ..start },
        // What is left may be too little.
        Err(_) => start,
    }
}

/// How far two poses are apart, radians and shares of the distance.
fn deviation(a: &Transform<Camera, Marker>, b: &Transform<Camera, Marker>) -> f64 {
    let (metres, radians) = a.distance_to(b);
    radians + metres / a.translation_m().norm().max(1e-6)
}
