//! What is behind the arm, as the configurations tell in which it is elsewhere.

use crate::observations::Observations;
use eyebolt_geometry::Mask;
use eyebolt_registration::{Margin, View};
use eyebolt_render::Raster;
use rayon::prelude::*;

/// What other configurations, and frames without the arm, saw at a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Behind {
    /// The same as is seen now: the scene, not the arm.
    Same,
    /// Only what is farther away than what is seen now: whatever is seen now came there.
    Farther,
    /// Nothing that would tell.
    Unknown,
}

/// The scene as a posed arm leaves it in view.
pub(super) struct KnownBackground<'a> {
    observations: &'a Observations,
    /// Of each view its depth and the pixels that are clear of the posed arm.
    views: Vec<(&'a [f32], Mask)>,
}

/// Edges of the arm, and what stereo makes of them, reach this far, pixels.
const CLEARANCE_PX: u32 = 8;
/// Other configurations looked at: the scene is no better known from more.
const MOST_VIEWS: usize = 12;

impl<'a> KnownBackground<'a> {
    /// The scene of `views`, of whose arms `rasters` are the drawings.
    pub fn new(observations: &'a Observations, views: &[View<'a>], rasters: &[Raster]) -> Self {
        let (width, height) = (observations.camera.width(), observations.camera.height());
        let seen = views.par_iter().zip(rasters).map(|(view, raster)| {
            let free = raster.inverse_depth().iter().map(|inverse| *inverse <= 0.0).collect();
            let free = Mask::new(width, height, free).expect("a raster is of its camera's size");
            (view.depth.depth_m(), free.eroded(CLEARANCE_PX))
        });
        Self { observations, views: seen.collect() }
    }

    /// What is behind `seen_m`, as the camera tells it (0: nothing), at a pixel of view `own`.
    pub fn behind(&self, own: usize, at: usize, seen_m: f32) -> Behind {
        let margin_m = self.observations.noise.margin_m(Margin::Search, seen_m);
        let stride = self.views.len().div_ceil(MOST_VIEWS).max(1);
        // From the next view on, so that `own` is the one left out.
        let others = (1..self.views.len()).step_by(stride).map(|by| (own + by) % self.views.len());
        let clear = others.filter_map(|other| {
            let (depth_m, free) = &self.views[other];
            free.as_slice()[at].then(|| depth_m[at])
        });
        let frames = self.observations.background.depth().map(|frame| frame.depth_m()[at]);
        let (mut found, mut blank) = (Behind::Unknown, false);
        for behind_m in clear.chain(frames) {
            match (seen_m > 0.0, behind_m > 0.0) {
                (true, true) if (behind_m - seen_m).abs() <= margin_m => return Behind::Same,
                (true, true) if behind_m > seen_m => found = Behind::Farther,
                // Seen once, there is a scene in range.
                (false, true) => return Behind::Farther,
                (false, false) => blank = true,
                _ => {}
            }
        }
        // Where nobody ever sees anything, something may stand too near to the camera.
        let in_sight = || self.views.iter().any(|(depth_m, _)| depth_m[at] > 0.0);
        if blank && in_sight() { Behind::Same } else { found }
    }
}
