//! Robust refinement of one pose over all configurations at once.

use crate::arm::ArmModel;
use crate::factors::{
    DEPTH_SCALE, Factor, OUTLINE_WIDTH, State, UNKNOWNS, outline_factor, surface_factor,
};
use crate::normal_equations::NormalEquations;
use crate::robust::{geman_mcclure, median};
use crate::silhouette::Silhouette;
use crate::view::View;
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_render::{Raster, contour};
use nalgebra::{Matrix6, Point3, SMatrix, SVector, Vector6};
use rayon::prelude::*;

/// One configuration in the refinement.
#[derive(Clone, Debug)]
pub struct RefineView<'a> {
    /// What was seen, and the arm's configuration.
    pub view: View<'a>,
    /// Points well inside the arm's outline: camera frame, metres.
    pub arm_points: Vec<Point3<f32>>,
    /// How many pixels each of them stands for.
    pub pixels_per_point: f64,
    /// The arm's outline, where it is known.
    pub silhouette: Silhouette,
}

/// How to refine.
#[derive(Clone, Copy, Debug)]
pub struct RefineOptions {
    /// Steps at most.
    pub iterations: usize,
    /// Scale of the robust weight on surfaces in the first step, metres; it shrinks to what the
    /// residuals show.
    pub surface_scale_m: f64,
    /// Likewise on outlines, pixels.
    pub outline_scale_px: f64,
    /// How much the two kinds of evidence count.
    pub trust: Trust,
}

/// How much the two kinds of evidence count: as much as their residuals deserve, or one of them
/// hardly at all, to see whether the two agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trust {
    /// Both.
    Both,
    /// Distances from surfaces.
    Surfaces,
    /// Distances from outlines.
    Outlines,
}

/// What remains of a kind of evidence that is not trusted: enough to determine the pose.
const DISTRUSTED: f64 = 0.01;

impl Trust {
    fn in_surfaces(self) -> f64 {
        if self == Self::Outlines { DISTRUSTED } else { 1.0 }
    }

    fn in_outlines(self) -> f64 {
        if self == Self::Surfaces { DISTRUSTED } else { 1.0 }
    }
}

/// Why a refinement stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopReason {
    /// The last step was negligible.
    Converged,
    /// It was still moving after as many steps as allowed.
    IterationLimit,
    /// The evidence does not determine the pose.
    Underdetermined,
}

/// How well one view fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewFit {
    /// Median distance of the arm's points from the posed surface, metres.
    pub surface_m: f64,
    /// Median distance of the posed contour from the outline seen, pixels; `None` if no outline
    /// was seen.
    pub outline_px: Option<f64>,
    /// Points on surfaces that the camera can see, within three deviations.
    pub inliers: usize,
    /// Points there were.
    pub points: usize,
}

/// Outcome of a refinement.
#[derive(Clone, Debug)]
pub struct Refinement {
    /// The pose.
    pub camera_from_base: Transform<Camera, Base>,
    /// True depth is `1 + depth_scale` times the depth seen, as far as the data tell.
    pub depth_scale: f64,
    /// By how many pixels the outline seen is wider than the arm.
    pub outline_px: f64,
    /// Information of translation (m) and rotation (rad) as weighted in the last step.
    pub information: Matrix6<f64>,
    /// Covariance of the same, from how the evidence of separate patches disagrees.
    pub covariance: Matrix6<f64>,
    /// Deviation of the surfaces' residuals, metres.
    pub surface_sigma_m: f64,
    /// Deviation of the outlines' residuals, pixels.
    pub outline_sigma_px: f64,
    /// One for each view.
    pub views: Vec<ViewFit>,
    /// Steps taken.
    pub iterations: usize,
    /// The last of them: translation (m) and rotation (rad).
    pub last_step: Vector6<f64>,
    /// Why it stopped.
    pub stop: StopReason,
}

/// Errors of depth go together over patches of about this many pixels.
const SURFACE_PATCH_PX: f64 = 400.0;
/// Errors of an outline go together over about this many pixels.
const OUTLINE_PATCH_PX: f64 = 8.0;
/// Prior deviation of the depth's scale.
const DEPTH_SCALE_PRIOR: f64 = 0.01;
/// Prior deviation of the outline's excess, pixels.
const OUTLINE_PRIOR_PX: f64 = 1.0;
/// Of the information scaled to a diagonal of ones: between what rounding leaves of nothing, 1e-15,
/// and what three points on a surface tell.
const LEAST_EIGENVALUE: f64 = 1e-10;
const LEAST_SURFACE_SIGMA_M: f64 = 0.001;
const LEAST_OUTLINE_SIGMA_PX: f64 = 0.7;
/// Contour points looked at in a view.
const CONTOUR_POINTS: usize = 1500;

/// Robust scales of one step.
#[derive(Clone, Copy)]
struct Scales {
    surface_m: f64,
    outline_px: f64,
}

/// How residuals are weighed in one step.
#[derive(Clone, Copy)]
struct Weighing {
    scales: Scales,
    sigma: Scales,
    trust: Trust,
}

/// Residuals of one view at one state.
struct Evidence {
    surface: Vec<Factor>,
    outline: Vec<Factor>,
    /// Cracks of the contour that each outline factor stands for.
    cracks_per_factor: f64,
    points: usize,
    pixels_per_point: f64,
}

/// Refines `camera_from_base` from `start` on all `views`.
///
/// Alternates between drawing the posed arm for its contour and one Gauss-Newton step on the
/// distances of points from surfaces and of the contour from the outline, both under Geman and
/// McClure's weight, along with depth scale and outline width under priors. `rasters`: one for
/// each view, of its camera's size.
pub fn refine(
    arm: &ArmModel,
    views: &[RefineView<'_>],
    rasters: &mut [Raster],
    start: &Transform<Camera, Base>,
    options: &RefineOptions,
) -> Refinement {
    let mut state = State { camera_from_base: *start, depth_scale: 0.0, outline_px: 0.0 };
    let mut scales =
        Scales { surface_m: options.surface_scale_m, outline_px: options.outline_scale_px };
    let mut stop = StopReason::IterationLimit;
    let mut iterations = 0;
    let mut last_step = Vector6::zeros();
    let mut evidence = gather(arm, views, rasters, &state);
    while iterations < options.iterations {
        iterations += 1;
        let sigma = deviations(&evidence, &scales);
        let weighing = Weighing { scales, sigma, trust: options.trust };
        let sum = total(&evidence, &weighing, &state);
        let Some(step) = sum.solve(1e-6) else {
            stop = StopReason::Underdetermined;
            break;
        };
        last_step = step.fixed_rows::<6>(0).into_owned();
        state = state.stepped(&step);
        evidence = gather(arm, views, rasters, &state);
        let settled = scales.surface_m <= 3.01 * sigma.surface_m.max(0.002)
            && scales.outline_px <= 3.01 * sigma.outline_px;
        if settled && negligible(&step) {
            stop = StopReason::Converged;
            break;
        }
        scales.surface_m = (0.6 * scales.surface_m).max(3.0 * sigma.surface_m.max(0.002));
        scales.outline_px = (0.6 * scales.outline_px).max(3.0 * sigma.outline_px);
    }
    let mut outcome = summarise(&state, &evidence, &scales, options.trust);
    if outcome.stop != StopReason::Underdetermined {
        outcome.stop = stop;
    }
    Refinement { iterations, last_step, ..outcome }
}

/// The contour is drawn to whole pixels: below a tenth of a millimetre and 0.01 degrees steps only
/// follow its jitter.
fn negligible(step: &SVector<f64, UNKNOWNS>) -> bool {
    step.fixed_rows::<3>(0).norm() < 1.0e-4 && step.fixed_rows::<3>(3).norm() < 1.75e-4
}

fn gather(
    arm: &ArmModel,
    views: &[RefineView<'_>],
    rasters: &mut [Raster],
    state: &State,
) -> Vec<Evidence> {
    let pairs = views.par_iter().zip(rasters.par_iter_mut());
    pairs.map(|(view, raster)| gather_one(arm, view, raster, state)).collect()
}

fn gather_one(
    arm: &ArmModel,
    view: &RefineView<'_>,
    raster: &mut Raster,
    state: &State,
) -> Evidence {
    let (camera, posture) = (view.view.camera, view.view.posture);
    raster.draw(camera, &posture.meshes(arm, &state.camera_from_base));
    let cracks = contour(raster, camera);
    let stride = cracks.len().div_ceil(CONTOUR_POINTS).max(1);
    let outline = cracks
        .iter()
        .step_by(stride)
        .filter(|crack| crack.behind_m.is_none())
        .filter_map(|crack| outline_factor(camera, &view.silhouette, state, crack))
        .collect();
    let surface =
        view.arm_points.iter().filter_map(|p| surface_factor(arm, posture, state, p)).collect();
    Evidence {
        surface,
        outline,
        cracks_per_factor: stride as f64,
        points: view.arm_points.len(),
        pixels_per_point: view.pixels_per_point,
    }
}

/// Deviation of the residuals that are within the robust scales, from their median size.
fn deviations(evidence: &[Evidence], scales: &Scales) -> Scales {
    let spread = |values: Vec<f64>, least: f64| {
        let mut values = values;
        median(&mut values).map_or(least, |m| (1.4826 * m).max(least))
    };
    let near = |factors: &mut dyn Iterator<Item = &Factor>, scale: f64| -> Vec<f64> {
        factors.map(|f| f.residual.abs()).filter(|r| *r < 2.0 * scale).collect()
    };
    let surface = near(&mut evidence.iter().flat_map(|e| &e.surface), scales.surface_m);
    let outline = near(&mut evidence.iter().flat_map(|e| &e.outline), scales.outline_px);
    Scales {
        surface_m: spread(surface, LEAST_SURFACE_SIGMA_M),
        outline_px: spread(outline, LEAST_OUTLINE_SIGMA_PX),
    }
}

impl Weighing {
    fn surface(&self, evidence: &Evidence, factor: &Factor) -> f64 {
        let patches = (evidence.pixels_per_point / SURFACE_PATCH_PX).min(1.0);
        let robust = geman_mcclure(factor.residual, self.scales.surface_m);
        self.trust.in_surfaces() * patches * robust / self.sigma.surface_m.powi(2)
    }

    fn outline(&self, evidence: &Evidence, factor: &Factor) -> f64 {
        let patches = (evidence.cracks_per_factor / OUTLINE_PATCH_PX).min(1.0);
        let robust = geman_mcclure(factor.residual, self.scales.outline_px);
        self.trust.in_outlines() * patches * robust / self.sigma.outline_px.powi(2)
    }
}

/// The linearised problem of all views, with the priors.
fn total(evidence: &[Evidence], weighing: &Weighing, state: &State) -> NormalEquations<UNKNOWNS> {
    let mut sum = NormalEquations::default();
    for view in evidence {
        for factor in &view.surface {
            sum.add(&factor.jacobian, factor.residual, weighing.surface(view, factor));
        }
        for factor in &view.outline {
            sum.add(&factor.jacobian, factor.residual, weighing.outline(view, factor));
        }
    }
    let priors = [
        (DEPTH_SCALE, state.depth_scale, DEPTH_SCALE_PRIOR),
        (OUTLINE_WIDTH, state.outline_px, OUTLINE_PRIOR_PX),
    ];
    for (unknown, value, deviation) in priors {
        sum.add(&SVector::ith(unknown, 1.0), value, deviation.powi(-2));
    }
    sum
}

fn summarise(state: &State, evidence: &[Evidence], scales: &Scales, trust: Trust) -> Refinement {
    let sigma = deviations(evidence, scales);
    let weighing = Weighing { scales: *scales, sigma, trust };
    let sum = total(evidence, &weighing, state);
    let views = evidence.iter().map(|view| view_fit(view, &sigma)).collect();
    let covariance = sandwich(evidence, &weighing, &sum);
    let inverse = sum.information.try_inverse();
    let pose_only = inverse
        .and_then(|c| c.fixed_view::<6, 6>(0, 0).into_owned().try_inverse())
        .unwrap_or_else(Matrix6::zeros);
    Refinement {
        camera_from_base: state.camera_from_base,
        depth_scale: state.depth_scale,
        outline_px: -state.outline_px,
        information: pose_only,
        covariance: covariance.unwrap_or_else(|| Matrix6::from_element(f64::INFINITY)),
        surface_sigma_m: sigma.surface_m,
        outline_sigma_px: sigma.outline_px,
        views,
        iterations: 0,
        last_step: Vector6::zeros(),
        stop: if covariance.is_none() {
            StopReason::Underdetermined
        } else {
            StopReason::Converged
        },
    }
}

/// Whether `information` is of full rank. Rounding, and the damping of the steps, make one that is
/// not look regular.
fn determines_all(information: &SMatrix<f64, UNKNOWNS, UNKNOWNS>) -> bool {
    let scale = information.diagonal().map(|d| d.sqrt().recip());
    let scaled = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::from_fn(|i, j| {
        information[(i, j)] * scale[i] * scale[j]
    });
    scaled.iter().all(|v| v.is_finite()) && scaled.symmetric_eigenvalues().min() > LEAST_EIGENVALUE
}

/// Covariance that does not trust the noise model: every link in every view is one patch whose
/// residuals may all be off together (Liang and Zeger's sandwich, Biometrika 1986).
fn sandwich(
    evidence: &[Evidence],
    weighing: &Weighing,
    sum: &NormalEquations<UNKNOWNS>,
) -> Option<Matrix6<f64>> {
    if !determines_all(&sum.information) {
        return None;
    }
    let bread = sum.information.try_inverse()?;
    let mut filling = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::zeros();
    for view in evidence {
        let links = view.surface.iter().chain(&view.outline).map(|f| f.link + 1).max().unwrap_or(0);
        let mut scores = vec![[SVector::<f64, UNKNOWNS>::zeros(); 2]; links];
        for factor in &view.surface {
            let weight = weighing.surface(view, factor);
            scores[factor.link][0] += factor.jacobian * (weight * factor.residual);
        }
        for factor in &view.outline {
            let weight = weighing.outline(view, factor);
            scores[factor.link][1] += factor.jacobian * (weight * factor.residual);
        }
        for score in scores.iter().flatten() {
            filling += score * score.transpose();
        }
    }
    filling[(DEPTH_SCALE, DEPTH_SCALE)] += DEPTH_SCALE_PRIOR.powi(-2);
    filling[(OUTLINE_WIDTH, OUTLINE_WIDTH)] += OUTLINE_PRIOR_PX.powi(-2);
    let covariance = bread * filling * bread;
    let pose: Matrix6<f64> = covariance.fixed_view::<6, 6>(0, 0).into_owned();
    pose.iter().all(|v| v.is_finite()).then(|| (pose + pose.transpose()) * 0.5)
}

fn view_fit(view: &Evidence, sigma: &Scales) -> ViewFit {
    let mut surface: Vec<f64> = view.surface.iter().map(|f| f.residual.abs()).collect();
    let mut outline: Vec<f64> = view.outline.iter().map(|f| f.residual.abs()).collect();
    ViewFit {
        inliers: surface.iter().filter(|r| **r < 3.0 * sigma.surface_m).count(),
        surface_m: median(&mut surface).unwrap_or(f64::INFINITY),
        outline_px: median(&mut outline),
        points: view.points,
    }
}
