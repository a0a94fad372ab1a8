//! What single views decide: the answers without them.

use super::poses::{HandEye, View};
use super::system::{Scale, State, Sums, damped, sums};
use eyebolt_geometry::{CoordinateFrame, PinholeCamera, Tangent};
use nalgebra::Matrix6;

/// With more views, several that follow each other are left out together.
const MOST_PARTS: usize = 30;
/// Fewer views than this leave too little to say anything without one of them.
const FEWEST_VIEWS: usize = 4;

/// The answers without some of the views.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOut<Root: CoordinateFrame, Carrier: CoordinateFrame> {
    /// One for each view, or for each of thirty groups of views.
    pub answers: Vec<HandEye<Root, Carrier>>,
    /// Covariance of `camera_from_root` by the jackknife (Efron and Stein 1981).
    pub covariance: Matrix6<f64>,
}

/// The answers without each part of `views`, near `state`; `None` if one part is all that holds it.
pub(super) fn leave_out<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    state: &State<Root, Carrier>,
    views: &[View<Root, Carrier>],
    camera: &PinholeCamera,
    scale: &Scale,
) -> Option<LeftOut<Root, Carrier>> {
    if views.len() < FEWEST_VIEWS {
        return None;
    }
    let parts = views.len().min(MOST_PARTS);
    let part_of = |view: usize| view * parts / views.len();
    let without = |part: usize| settle(state, views, camera, scale, |view| part_of(view) == part);
    let states: Vec<State<Root, Carrier>> = (0..parts).map(without).collect::<Option<_>>()?;
    let pose = &state.hand_eye.camera_from_root;
    let moved: Vec<Tangent> =
        states.iter().map(|other| pose.local(&other.hand_eye.camera_from_root)).collect();
    let count = parts as f64;
    let mean = moved.iter().sum::<Tangent>() / count;
    let spread: Matrix6<f64> = moved.iter().map(|m| (m - mean) * (m - mean).transpose()).sum();
    let answers = states.iter().map(|state| state.hand_eye).collect();
    Some(LeftOut { answers, covariance: spread * ((count - 1.0) / count) })
}

/// Steps of the answers without some views: from where they start, each is a few standard deviations.
const STEPS: usize = 4;

/// From `state`, without the views that `is_out` says.
fn settle<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    state: &State<Root, Carrier>,
    views: &[View<Root, Carrier>],
    camera: &PinholeCamera,
    scale: &Scale,
    is_out: impl Fn(usize) -> bool,
) -> Option<State<Root, Carrier>> {
    let mut state = *state;
    for _ in 0..STEPS {
        let mut total = Sums::prior(state.log_size);
        for (_, view) in views.iter().enumerate().filter(|(i, _)| !is_out(*i)) {
            total.add(&sums(&state, view, camera, scale));
        }
        let step = damped(&total.information, 0.0)?.solve(&-total.gradient);
        state = state.moved(&step);
    }
    Some(state)
}
