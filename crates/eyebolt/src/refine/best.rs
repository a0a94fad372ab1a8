//! From hypotheses to one refined answer.

use super::camera_moved::{CameraMoved, find_change};
use super::configuration::{ConfigurationOutcome, Dropped, taking_part, too_many_misplaced};
use super::shortlist;
use super::workspace::Workspace;
use crate::evenly::evenly;
use crate::observations::Observations;
use crate::pose::Hypothesis;
use crate::progress::{Cancelled, Progress};
use eyebolt_geometry::{Base, Camera, Mask, Transform};
use eyebolt_registration::{Labels, RefineView, Refinement};
use eyebolt_render::Raster;
use rayon::prelude::*;

/// The best of the hypotheses, refined on every configuration that takes part.
#[derive(Debug)]
pub struct Refined<'a> {
    /// What the last refinement says, in the observations' own camera frame.
    pub refinement: Refinement,
    /// Which configurations of the observations it was fitted to.
    pub(crate) indices: Vec<usize>,
    /// Buffers to draw them in.
    pub(crate) rasters: Vec<Raster>,
    /// What it saw of each of them.
    pub(crate) seen: Vec<RefineView<'a>>,
    /// When the camera was found to have moved, in order of time: the refinement is of what came after.
    pub camera_moved: Vec<CameraMoved>,
    /// Another pose that explained nearly as much before it was refined to its end.
    pub(crate) rival: Option<Transform<Camera, Base>>,
}

/// What became of hypotheses.
#[derive(Debug)]
pub struct Found<'a> {
    /// One for each configuration of the observations.
    pub configurations: Vec<ConfigurationOutcome>,
    /// Pixels of the arm in each of them, as they were labelled before the pose was known.
    pub(crate) masks: Vec<Mask>,
    /// `None` if no hypothesis could be refined.
    pub refined: Option<Refined<'a>>,
}

/// Hypotheses are told apart by no more configurations than this, evenly chosen: as many as the global
/// search looks at.
const SHORTLIST_CONFIGURATIONS: usize = 8;

/// Refines each of `hypotheses` a little, the best one to its end, and once more without those
/// configurations in which the camera sees through a link.
///
/// # Errors
///
/// Cancelled.
pub fn refine_best<'a>(
    observations: &'a Observations,
    labels: &[Labels],
    hypotheses: &[Hypothesis],
    progress: &dyn Progress,
) -> Result<Found<'a>, Cancelled> {
    let (width, height) = (observations.camera.width(), observations.camera.height());
    let masks: Vec<Mask> =
        labels.par_iter().map(|labels| labels.robot_mask(width, height)).collect();
    let mut configurations = outcomes(observations, &masks);
    let mut workspace = Workspace::new(observations, &masks, taking_part(&configurations));
    let few = evenly(&workspace.indices, SHORTLIST_CONFIGURATIONS);
    let mut few =
        Workspace::with(observations, &masks, few, std::mem::take(&mut workspace.rasters));
    let best = shortlist::choose(&mut few, hypotheses, progress)?;
    workspace = Workspace::with(observations, &masks, workspace.indices, few.rasters);
    let Some(best) = best else {
        return Ok(Found { configurations, masks, refined: None });
    };
    progress.advance(1, 2)?;
    let (mut refinement, mut seen) = workspace.refine(&best.camera_from_base.into());
    let mut camera_moved = Vec::new();
    while let Some(change) = find_change(&mut workspace, &refinement, &seen) {
        for index in &workspace.indices[..change.before] {
            configurations[*index].dropped = Some(Dropped::BeforeCameraMoved);
        }
        let indices = taking_part(&configurations);
        workspace = Workspace::with(observations, &masks, indices, workspace.rasters);
        (refinement, seen) = (change.later, change.seen);
        camera_moved.push(change.moved);
    }
    let misplaced = workspace.find_misplaced(&refinement, &mut configurations);
    if misplaced > 0 && !too_many_misplaced(&configurations) {
        tracing::debug!(misplaced, "refining again without configurations with a misplaced link");
        let indices = taking_part(&configurations);
        workspace = Workspace::with(observations, &masks, indices, workspace.rasters);
        (refinement, seen) = workspace.refine(&refinement.end());
    }
    let Workspace { indices, rasters, .. } = workspace;
    let rival = best.rival;
    let refined = Some(Refined { refinement, indices, rasters, seen, camera_moved, rival });
    Ok(Found { configurations, masks, refined })
}

/// Share of an image's pixels that has to be the arm.
const LEAST_ARM_SHARE: f64 = 1e-3;

fn outcomes(observations: &Observations, masks: &[Mask]) -> Vec<ConfigurationOutcome> {
    let least = (LEAST_ARM_SHARE * observations.camera.pixel_count() as f64) as usize;
    let pairs = observations.configurations.par_iter().zip(masks);
    pairs
        .map(|(configuration, mask)| {
            let depth = configuration.depth.depth_m();
            let seen = mask.as_slice().iter().zip(depth).filter(|(m, z)| **m && **z > 0.0);
            let pixels = seen.count();
            if pixels < least {
                tracing::debug!(frames = ?configuration.frames, pixels, least, "too little of the arm");
            }
            ConfigurationOutcome {
                frames: configuration.frames.clone(),
                dropped: (pixels < least).then_some(Dropped::FewPixels { pixels }),
                residual_m: None,
                agreement: None,
            }
        })
        .collect()
}
