//! Robust refinement of one pose over all configurations at once.

mod evidence;
mod joint_prior;
mod places;
mod summary;
mod weighing;

pub use weighing::Trust;

use crate::arm::{ArmModel, JointOffsets, MOST_JOINTS};
use crate::factors::{State, UNKNOWNS};
use crate::silhouette::Silhouette;
use crate::view::View;
use evidence::gather;
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_render::Raster;
use nalgebra::{Matrix6, Point3, SVector, Vector6};
use weighing::{Scales, Weighing};

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
    /// How far off joints may be.
    pub joint_prior: JointPrior,
}

/// What is known beforehand of how far off joints are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointPrior {
    /// Each by this standard deviation.
    Known {
        /// The deviations, radians.
        rad: [f64; MOST_JOINTS],
    },
    /// All by the same deviation, which the data tell, but for joints that stand out.
    Estimated,
}

/// Where a refinement begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// The pose.
    pub camera_from_base: Transform<Camera, Base>,
    /// How much farther the joints stand than they say.
    pub joint_offsets: JointOffsets,
}

impl From<Transform<Camera, Base>> for Start {
    /// At a pose, with every joint where it says.
    fn from(camera_from_base: Transform<Camera, Base>) -> Self {
        Self { camera_from_base, joint_offsets: JointOffsets::default() }
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

impl Refinement {
    /// From where another refinement would go on.
    pub fn end(&self) -> Start {
        Start { camera_from_base: self.camera_from_base, joint_offsets: self.joint_offsets }
    }
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
    /// How much farther the joints stand than they say, as far as the data tell.
    pub joint_offsets: JointOffsets,
    /// Standard deviation of each of them by what is seen of that joint alone, whatever the others
    /// are off by, radians; infinite where nothing is determined.
    pub joint_sigma_rad: [f64; MOST_JOINTS],
    /// Prior deviation of each of them that this came with, radians.
    pub joint_prior_rad: [f64; MOST_JOINTS],
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

/// Refines the pose from `start` on all `views`.
///
/// Alternates between drawing the posed arm for its contour and one Gauss-Newton step on the
/// distances of points from surfaces and of the contour from the outline, both under Geman and
/// McClure's weight, along with depth scale and outline width under priors. `rasters`: one for
/// each view, of its camera's size.
pub fn refine(
    arm: &ArmModel,
    views: &[RefineView<'_>],
    rasters: &mut [Raster],
    start: &Start,
    options: &RefineOptions,
) -> Refinement {
    let mut state = State::new(start.camera_from_base, start.joint_offsets);
    let mut scales =
        Scales { surface_m: options.surface_scale_m, outline_px: options.outline_scale_px };
    let mut stop = StopReason::IterationLimit;
    let mut iterations = 0;
    let mut last_step = Vector6::zeros();
    let places = places::places(views);
    let mut evidence = gather(arm, views, rasters, &places, &state);
    while iterations < options.iterations {
        iterations += 1;
        let weighing = Weighing::of(arm, &evidence, &scales, &state, options);
        let sigma = weighing.sigma;
        let Some(step) = weighing.total(&evidence, &state).solve(1e-6) else {
            stop = StopReason::Underdetermined;
            break;
        };
        last_step = step.fixed_rows::<6>(0).into_owned();
        state = state.stepped(&step);
        evidence = gather(arm, views, rasters, &places, &state);
        let settled = scales.surface_m <= 3.01 * sigma.surface_m.max(0.002)
            && scales.outline_px <= 3.01 * sigma.outline_px;
        if settled && negligible(&step) {
            stop = StopReason::Converged;
            break;
        }
        scales.surface_m = (0.6 * scales.surface_m).max(3.0 * sigma.surface_m.max(0.002));
        scales.outline_px = (0.6 * scales.outline_px).max(3.0 * sigma.outline_px);
    }
    let weighing = Weighing::of(arm, &evidence, &scales, &state, options);
    let mut outcome = summary::summarise(&state, &evidence, &weighing);
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
