//! Camera pose, marker pose and marker size together, by what the pictures show.

use super::left_out::{LeftOut, leave_out};
use super::poses::{HandEye, View};
use super::system::{Information, Scale, State, Sums, damped, residuals, sums, total};
use eyebolt_geometry::{CoordinateFrame, PinholeCamera};
use nalgebra::Matrix6;

/// Points within this many standard deviations count nearly in full.
const ROBUST_SIGMAS: f64 = 5.0;
/// No corner is known better, pixels: what is left over of few views may happen to be less, and good views
/// would then seem to be bad.
const LEAST_SIGMA_PX: f64 = 0.05;
/// Median of a two-dimensional normal distribution's length, in standard deviations of a coordinate.
const MEDIAN: f64 = 1.1774;
const STEPS: usize = 60;
/// A step smaller than this ends the refinement, metres and radians.
const SETTLED: f64 = 1e-9;

/// What refinement found.
#[derive(Clone, Debug, PartialEq)]
pub struct Refined<Root: CoordinateFrame, Carrier: CoordinateFrame> {
    /// The answer.
    pub hand_eye: HandEye<Root, Carrier>,
    /// How much larger than described the marker is, as a share: 0.01 is one percent.
    pub size_error: f64,
    /// Standard deviation of that.
    pub size_sigma: f64,
    /// Standard deviation of a coordinate of a point in the picture, pixels.
    pub sigma_px: f64,
    /// Covariance of `camera_from_root` in the coordinates of [`Transform::retract`]: that of independent points,
    /// enlarged by how much more the views scatter than that.
    ///
    /// [`Transform::retract`]: eyebolt_geometry::Transform::retract
    pub covariance: Matrix6<f64>,
    /// The same of `carrier_from_marker`.
    pub marker_covariance: Matrix6<f64>,
    /// How each view fits.
    pub views: Vec<ViewFit>,
    /// The answers without some of the views; `None` if they do not determine one.
    pub left_out: Option<LeftOut<Root, Carrier>>,
    /// What the refinement minimised.
    pub cost: f64,
    /// Length of the last step, metres and radians: where it is not tiny, the answer was not reached.
    pub last_step: f64,
}

/// How a view fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewFit {
    /// Root mean square distance of the points seen from where they should be, pixels; infinite if one
    /// could not be seen there.
    pub rms_px: f64,
    /// Mean weight of its points, 1 for those that fit: below a half, the view was hardly listened to.
    pub weight: f64,
}

/// The answer near `start` with the least reprojection error over all `views`, by Geman and McClure's weights.
///
/// `None` if the views do not determine it.
pub fn refine<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    views: &[View<Root, Carrier>],
    camera: &PinholeCamera,
    start: &HandEye<Root, Carrier>,
) -> Option<Refined<Root, Carrier>> {
    let mut state = State { hand_eye: *start, log_size: 0.0 };
    let mut scale = scale(&state, views, camera)?;
    let mut damping = 1e-6;
    let mut last_step = f64::INFINITY;
    for _ in 0..STEPS {
        let now = total(&state, views, camera, &scale);
        let step = damped(&now.information, damping)?.solve(&-now.gradient);
        let next = state.moved(&step);
        let cost = total(&next, views, camera, &scale).cost;
        if cost > now.cost || cost.is_nan() {
            damping *= 10.0;
            if damping > 1e12 {
                break;
            }
            continue;
        }
        state = next;
        damping = (0.1 * damping).max(1e-12);
        last_step = step.norm();
        let before = scale;
        // Residuals get smaller on the way; what has been let in stays in.
        scale = self::scale(&state, views, camera)?;
        let settled = (scale.sigma_px / before.sigma_px - 1.0).abs() < 1e-6;
        if last_step < SETTLED && settled {
            break;
        }
    }
    finish(&state, views, camera, &scale, last_step)
}

/// How large residuals are; `None` without any.
fn scale<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    state: &State<Root, Carrier>,
    views: &[View<Root, Carrier>],
    camera: &PinholeCamera,
) -> Option<Scale> {
    let all = views.iter().flat_map(|view| residuals(state, view, camera));
    let mut sizes: Vec<f64> =
        all.map(|residual| residual.map_or(f64::INFINITY, |r| r.norm())).collect();
    sizes.sort_by(f64::total_cmp);
    let middle = *sizes.get(sizes.len() / 2)?;
    // The state has as many unknowns as some points have coordinates: what is left is smaller than the
    // errors were.
    let coordinates = 2.0 * sizes.len() as f64;
    let freedom = (coordinates / (coordinates - 13.0).max(1.0)).sqrt();
    let sigma_px = (middle / MEDIAN * freedom).max(LEAST_SIGMA_PX);
    sigma_px.is_finite().then_some(Scale { sigma_px, robust_px: ROBUST_SIGMAS * sigma_px })
}

fn finish<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    state: &State<Root, Carrier>,
    views: &[View<Root, Carrier>],
    camera: &PinholeCamera,
    scale: &Scale,
    last_step: f64,
) -> Option<Refined<Root, Carrier>> {
    let each: Vec<Sums> = views.iter().map(|view| sums(state, view, camera, scale)).collect();
    let mut total = Sums::prior(state.log_size);
    each.iter().for_each(|view| total.add(view));
    let inverse = damped(&total.information, 0.0)?.inverse();
    let covariance = inverse * overdispersion(&each, &inverse, views);
    let block = |at: usize| -> Matrix6<f64> { covariance.fixed_view::<6, 6>(at, at).into_owned() };
    Some(Refined {
        hand_eye: state.hand_eye,
        size_error: state.log_size.exp_m1(),
        size_sigma: covariance[(12, 12)].sqrt(),
        sigma_px: scale.sigma_px,
        covariance: block(0),
        marker_covariance: block(6),
        views: views.iter().map(|view| fit(state, view, camera, scale)).collect(),
        left_out: leave_out(state, views, camera, scale),
        cost: total.cost,
        last_step,
    })
}

/// How many times larger the scatter of the views is than that of independent points, at least 1: errors of
/// the robot move all points of a view together.
///
/// A single number, the mean of the sandwich over all directions (Liang and Zeger 1986): there may be fewer
/// views than unknowns, and then the sandwich itself knows nothing of some directions.
fn overdispersion<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    each: &[Sums],
    inverse: &Information,
    views: &[View<Root, Carrier>],
) -> f64 {
    let scatter: Information =
        each.iter().map(|view| view.gradient * view.gradient.transpose()).sum();
    let count = views.len() as f64;
    let coordinates = 2.0 * views.iter().map(|view| view.points.len()).sum::<usize>() as f64;
    // For the unknowns that were fitted.
    let few = count / (count - 1.0).max(1.0) * (coordinates - 1.0) / (coordinates - 13.0).max(1.0);
    (few * (inverse * scatter).trace() / inverse.nrows() as f64).max(1.0)
}

fn fit<Root: CoordinateFrame, Carrier: CoordinateFrame>(
    state: &State<Root, Carrier>,
    view: &View<Root, Carrier>,
    camera: &PinholeCamera,
    scale: &Scale,
) -> ViewFit {
    let (mut squares, mut weights) = (0.0, 0.0);
    for residual in residuals(state, view, camera) {
        let square = residual.map_or(f64::INFINITY, |r| r.norm_squared());
        squares += square;
        weights += (1.0 + square / scale.robust_px.powi(2)).powi(-2);
    }
    let count = view.points.len().max(1) as f64;
    ViewFit { rms_px: (squares / count).sqrt(), weight: weights / count }
}
