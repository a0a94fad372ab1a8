//! A pose from nothing: the candidates for `camera_from_base` that explain what moved.

use crate::label::moving_masks;
use crate::session::{Configuration, Session};
use eyebolt_geometry::Mask;
use eyebolt_registration::{Candidate, SearchView, SurfacePoint, search};
use nalgebra::Point3;
use rayon::prelude::*;

/// The search looks at no more configurations than this; the rest would tell it little.
const CONFIGURATIONS: usize = 8;
/// Points of a configuration that the search looks at.
const SEARCH_POINTS: usize = 2000;
/// The rim of a mask mixes arm and background, pixels.
const RIM_PX: u32 = 2;
/// A part of the arm that comes no nearer than this to where it is in another configuration has
/// moved, metres.
const MOVED_M: f32 = 0.04;

/// The arm's pixels as far as they are known before any pose is: the masks of the recording, or
/// what moved.
pub fn arm_masks(session: &Session) -> Vec<Mask> {
    let given: Option<Vec<Mask>> = session.configurations.iter().map(|c| c.mask.clone()).collect();
    let background = session.background.depth();
    given.unwrap_or_else(|| moving_masks(&session.configurations, background))
}

/// Candidates for `camera_from_base`, best first, from the pixels in `masks` and the kinematics
/// alone. Configurations whose mask is too small to say anything take no part.
pub fn start(session: &Session, masks: &[Mask], seed: u64, wanted: usize) -> Vec<Candidate> {
    let whole = session.shows_whole_arm();
    let least = SEARCH_POINTS / 20;
    let count = session.configurations.len();
    let usable: Vec<usize> = (0..count).filter(|index| masks[*index].count() >= least).collect();
    let stride = usable.len().div_ceil(CONFIGURATIONS).max(1);
    let views: Vec<SearchView<'_>> = usable
        .into_par_iter()
        .step_by(stride)
        .filter_map(|index| {
            let (configuration, mask) = (&session.configurations[index], &masks[index]);
            let arm_points = points(session, configuration, &mask.eroded(RIM_PX));
            let surface = surface(session, configuration, whole);
            let view = session.view(configuration);
            (arm_points.len() >= least && !surface.is_empty()).then_some(SearchView {
                view,
                arm_points,
                surface,
            })
        })
        .collect();
    search(&session.arm, &views, seed, wanted)
}

/// Points seen at the pixels of `mask`, evenly thinned, camera frame.
fn points(session: &Session, configuration: &Configuration, mask: &Mask) -> Vec<Point3<f32>> {
    let depth = configuration.depth.depth_m();
    let set = mask.as_slice().iter().zip(depth).enumerate();
    let all: Vec<usize> = set.filter(|(_, (m, z))| **m && **z > 0.0).map(|(at, _)| at).collect();
    let stride = all.len().div_ceil(SEARCH_POINTS).max(1);
    let point = |at: &usize| session.rays.point(*at, depth[*at]);
    all.iter().step_by(stride).map(point).collect()
}

/// The arm's surface in the base frame: all of it, or what moves from one configuration to another.
fn surface(session: &Session, configuration: &Configuration, whole: bool) -> Vec<SurfacePoint> {
    let posture = &configuration.posture;
    let links = session.arm.links().iter().zip(posture.base_from_link());
    let all = links.flat_map(|(link, base_from_link)| {
        link.model.surface.iter().map(|s| SurfacePoint {
            point: base_from_link.point(&s.point.cast()).cast(),
            normal: base_from_link.direction(&s.normal.cast()).cast(),
        })
    });
    let moves = |s: &SurfacePoint| {
        whole
            || session.configurations.iter().any(|other| {
                let nearest = other.posture.nearest(&session.arm, &s.point);
                nearest.is_none_or(|nearest| nearest.distance_m > MOVED_M)
            })
    };
    all.filter(moves).collect()
}
