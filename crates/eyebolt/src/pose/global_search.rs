//! A pose from nothing: hypotheses that explain the arm's pixels by kinematics alone.

use super::patches::middles;
use super::proposer::{Hypothesis, PoseProposer};
use crate::evenly::evenly;
use crate::label::Labelling;
use crate::observations::{Configuration, Observations};
use eyebolt_geometry::Mask;
use eyebolt_registration::{SearchView, SurfacePoint, search};
use nalgebra::Point3;
use rayon::prelude::*;
use std::error::Error;

/// The search looks at no more configurations than this; the rest would tell it little.
const CONFIGURATIONS: usize = 8;
/// Points of a configuration that the search looks at.
const SEARCH_POINTS: usize = 2000;
/// The rim of a mask mixes arm and background, pixels.
const RIM_PX: u32 = 2;
/// A part of the arm that comes no nearer than this to where it is in another configuration has
/// moved, metres.
const MOVED_M: f32 = 0.04;

/// Looks at all rotations and translations; nothing has to be known beforehand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GlobalSearch {
    /// Turns the grid of rotations that the search starts from: another seed, another way to the
    /// same answer.
    pub seed: u64,
    /// How many hypotheses are handed on.
    pub wanted: usize,
}

impl GlobalSearch {
    /// The search with this seed; the first few hypotheses hold the right one.
    pub fn new(seed: u64) -> Self {
        Self { seed, wanted: 4 }
    }
}

impl PoseProposer for GlobalSearch {
    /// Configurations with too few pixels of the arm to say anything take no part.
    fn propose(
        &self,
        observations: &Observations,
        labelling: &Labelling,
    ) -> Result<Vec<Hypothesis>, Box<dyn Error + Send + Sync>> {
        let (width, height) = (observations.camera.width(), observations.camera.height());
        let masks: Vec<Mask> =
            labelling.labels.par_iter().map(|labels| labels.robot_mask(width, height)).collect();
        let least = SEARCH_POINTS / 20;
        let count = observations.configurations.len();
        let usable: Vec<usize> =
            (0..count).filter(|index| masks[*index].count() >= least).collect();
        let views: Vec<SearchView<'_>> = evenly(&usable, CONFIGURATIONS)
            .into_par_iter()
            .filter_map(|index| {
                let (configuration, mask) = (&observations.configurations[index], &masks[index]);
                let mask = mask.eroded(RIM_PX);
                let arm_points = points(observations, configuration, &mask);
                let middles = middles(observations, configuration, &mask);
                let surface = surface(observations, configuration, labelling.whole_arm);
                let view = observations.view(configuration);
                let enough = arm_points.len() >= least && !surface.is_empty();
                enough.then_some(SearchView { view, arm_points, middles, surface })
            })
            .collect();
        let found = search(&observations.arm, &views, self.seed, self.wanted);
        let hypothesis = |candidate: &eyebolt_registration::Candidate| Hypothesis {
            camera_from_base: candidate.camera_from_base,
            score: candidate.score(),
        };
        Ok(found.iter().map(hypothesis).collect())
    }
}

/// Points seen at the pixels of `mask`, evenly thinned, camera frame.
fn points(
    observations: &Observations,
    configuration: &Configuration,
    mask: &Mask,
) -> Vec<Point3<f32>> {
    let depth = configuration.depth.depth_m();
    let set = mask.as_slice().iter().zip(depth).enumerate();
    let all: Vec<usize> = set.filter(|(_, (m, z))| **m && **z > 0.0).map(|(at, _)| at).collect();
    let stride = all.len().div_ceil(SEARCH_POINTS).max(1);
    let point = |at: &usize| observations.rays.point(*at, depth[*at]);
    all.iter().step_by(stride).map(point).collect()
}

/// The arm's surface in the base frame: all of it, or what moves from one configuration to another.
fn surface(
    observations: &Observations,
    configuration: &Configuration,
    whole: bool,
) -> Vec<SurfacePoint> {
    let posture = &configuration.posture;
    let links = observations.arm.links().iter().zip(posture.base_from_link());
    let all = links.flat_map(|(link, base_from_link)| {
        link.model.surface.iter().map(|s| SurfacePoint {
            point: base_from_link.point(&s.point.cast()).cast(),
            normal: base_from_link.direction(&s.normal.cast()).cast(),
        })
    });
    let moves = |s: &SurfacePoint| {
        whole
            || observations.configurations.iter().any(|other| {
                let nearest = other.posture.nearest(&observations.arm, &s.point);
                nearest.is_none_or(|nearest| nearest.distance_m > MOVED_M)
            })
    };
    all.filter(moves).collect()
}
