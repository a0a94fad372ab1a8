//! From what pictures show of a marker to an answer with a verdict.

use super::arrangement::Arrangement;
use super::error::{MarkerErrorEstimate, estimate};
use super::observe::MarkerObservations;
use super::reason::{DroppedView, MarkerReason};
use crate::calibrate::Limits;
use eyebolt_geometry::{Camera, Transform};
use eyebolt_markers::hand_eye::{HandEyeError, Refined, Start, View, refine, starts};
use eyebolt_markers::planar_poses;

/// Fewer views leave nothing to check the answer with.
const FEWEST_VIEWS: usize = 4;
/// A view that counts less than this does not fit the others.
const LEAST_WEIGHT: f64 = 0.5;
/// Share of the views that may not fit: more of them, and it is the others that are wrong.
const MOST_OFF: f64 = 0.3;
/// Corners of a fixed marker are seen to tenths of a pixel, and good arms are off by less than a millimetre.
const LARGEST_SIGMA_PX: f64 = 3.0;
/// Markers that are printed are off by a percent or two.
const LARGEST_SIZE_ERROR: f64 = 0.03;
/// A last step larger than this says that the refinement was still on its way, metres and radians.
const SETTLED: f64 = 1e-4;

/// An answer, trusted or not.
#[derive(Clone, Debug)]
pub struct MarkerCalibration<A: Arrangement> {
    /// The depth optical frame against what the camera stands on; `None` if nothing was found at all.
    pub camera_from_root: Option<Transform<Camera, A::Root>>,
    /// What refinement found, of the colour camera.
    pub refined: Option<Refined<A::Root, A::Carrier>>,
    /// What the closed-form solvers said, of the colour camera.
    pub starts: Vec<Start<A::Root, A::Carrier>>,
    /// How far off the answer is expected to be.
    pub error: Option<MarkerErrorEstimate>,
    /// One for each configuration that was looked at.
    pub configurations: Vec<MarkerOutcome>,
    /// Why it is refused; empty if it is trusted.
    pub reasons: Vec<MarkerReason>,
}

/// What became of a configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct MarkerOutcome {
    /// Root mean square distance of the marker's points from where the answer has them, pixels.
    pub rms_px: Option<f64>,
    /// Why it took no part.
    pub dropped: Option<DroppedView>,
}

/// Solves for the camera's place by all closed-form solvers, refines the best, and judges it by `limits`.
pub fn calibrate<A: Arrangement>(
    observations: &MarkerObservations,
    limits: &Limits,
) -> MarkerCalibration<A> {
    let mut configurations = Vec::new();
    let mut views = Vec::new();
    for configuration in &observations.configurations {
        let view = view::<A>(configuration, observations);
        let dropped = view.as_ref().err().cloned();
        configurations.push(MarkerOutcome { rms_px: None, dropped });
        views.extend(view.ok());
    }
    let mut calibration = MarkerCalibration {
        camera_from_root: None,
        refined: None,
        starts: starts(&views),
        error: None,
        configurations,
        reasons: Vec::new(),
    };
    let (seen, needed) = (views.len(), FEWEST_VIEWS.max(limits.configurations));
    if seen < needed {
        let configurations = observations.configurations.len();
        calibration.reasons.push(MarkerReason::FewViews { seen, configurations, needed });
    }
    let Some(refined) = best::<A>(&calibration.starts, &views, observations) else {
        let open = calibration.starts.iter().find_map(|start| start.answer.err());
        let few = matches!(open, Some(HandEyeError::FewPoses { .. }));
        let reason = open.map_or(MarkerReason::Underdetermined, MarkerReason::Open);
        if !few || calibration.reasons.is_empty() {
            calibration.reasons.push(reason);
        }
        return calibration;
    };
    let used = calibration.configurations.iter_mut().filter(|outcome| outcome.dropped.is_none());
    for (outcome, fit) in used.zip(&refined.views) {
        outcome.rms_px = Some(fit.rms_px);
        let off = fit.weight < LEAST_WEIGHT;
        outcome.dropped = off.then_some(DroppedView::Off { rms_px: fit.rms_px });
    }
    let error =
        estimate::<A>(&refined, &views, &observations.camera, &observations.depth_from_color);
    calibration.reasons.extend(judge(&refined, &error, limits));
    calibration.camera_from_root =
        Some(observations.depth_from_color * refined.hand_eye.camera_from_root);
    tracing::debug!(reasons = ?calibration.reasons, expected = ?error.expected, "judged by the marker");
    calibration.error = Some(error);
    calibration.refined = Some(refined);
    calibration
}

fn view<A: Arrangement>(
    configuration: &super::observe::MarkerConfiguration,
    observations: &MarkerObservations,
) -> Result<View<A::Root, A::Carrier>, DroppedView> {
    let sighting = configuration.seen.as_ref().map_err(|why| DroppedView::NotSeen(why.clone()))?;
    let poses = planar_poses(&sighting.points, &observations.camera);
    if poses.is_empty() {
        return Err(DroppedView::NoPose);
    }
    let root_from_carrier = A::root_from_carrier(&configuration.base_from_end_effector);
    Ok(View { root_from_carrier, points: sighting.points.clone(), poses })
}

/// Of the refined answers of all solvers, the one that fits best.
fn best<A: Arrangement>(
    starts: &[Start<A::Root, A::Carrier>],
    views: &[View<A::Root, A::Carrier>],
    observations: &MarkerObservations,
) -> Option<Refined<A::Root, A::Carrier>> {
    let answers = starts.iter().filter_map(|start| start.answer.ok());
    let refined = answers.filter_map(|answer| refine(views, &observations.camera, &answer));
    refined.min_by(|a, b| {
        // Costs are in units of each one's own residuals: the smaller these are, the better.
        a.sigma_px.total_cmp(&b.sigma_px).then(a.cost.total_cmp(&b.cost))
    })
}

fn judge<Root, Carrier>(
    refined: &Refined<Root, Carrier>,
    error: &MarkerErrorEstimate,
    limits: &Limits,
) -> Vec<MarkerReason>
where
    Root: eyebolt_geometry::CoordinateFrame,
    Carrier: eyebolt_geometry::CoordinateFrame,
{
    let mut reasons = Vec::new();
    let off = refined.views.iter().filter(|view| view.weight < LEAST_WEIGHT).count();
    let seen = refined.views.len();
    if refined.last_step > SETTLED || refined.last_step.is_nan() {
        reasons.push(MarkerReason::NotSettled);
    }
    if off as f64 > MOST_OFF * seen as f64 {
        reasons.push(MarkerReason::Outliers { off, seen });
    }
    if refined.sigma_px > LARGEST_SIGMA_PX {
        let limit_px = LARGEST_SIGMA_PX;
        reasons.push(MarkerReason::Residual { rms_px: refined.sigma_px, limit_px });
    }
    if refined.size_error.abs() > LARGEST_SIZE_ERROR {
        let (percent, limit) = (100.0 * refined.size_error, 100.0 * LARGEST_SIZE_ERROR);
        reasons.push(MarkerReason::Size { percent, limit });
    }
    let (expected, limit) = (&error.expected, limits.expected);
    let accurate = expected.translation_m <= limit.translation_m
        && expected.rotation_rad <= limit.rotation_rad;
    if reasons.is_empty() && !accurate {
        reasons.push(MarkerReason::Inaccurate {
            translation_mm: 1e3 * expected.translation_m,
            rotation_deg: expected.rotation_rad.to_degrees(),
            limit_mm: 1e3 * limit.translation_m,
            limit_deg: limit.rotation_rad.to_degrees(),
        });
    }
    reasons
}
