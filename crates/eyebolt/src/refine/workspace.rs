//! The configurations that take part, and the buffers to work on them.

use super::agreement::{Agreement, agreement};
use super::configuration::{ConfigurationOutcome, Dropped};
use super::links::misplaced_link;
use super::pixels::PixelCounts;
use super::rounds::{CLOSING, refine};
use crate::observations::Observations;
use eyebolt_geometry::Mask;
use eyebolt_registration::{Posture, RefineView, Refinement, Start, View};
use eyebolt_render::Raster;

/// The configurations that take part, and the buffers to work on them.
pub(crate) struct Workspace<'a, 'm> {
    pub(crate) observations: &'a Observations,
    /// Which configurations of the observations these are.
    pub(crate) indices: Vec<usize>,
    pub(crate) views: Vec<View<'a>>,
    masks: Vec<&'m Mask>,
    pub(crate) rasters: Vec<Raster>,
}

impl<'a, 'm> Workspace<'a, 'm> {
    /// A workspace for those configurations that `indices` names; `masks` are of all.
    pub(crate) fn new(
        observations: &'a Observations,
        masks: &'m [Mask],
        indices: Vec<usize>,
    ) -> Self {
        Self::with(observations, masks, indices, Vec::new())
    }

    /// As [`Self::new`], with the buffers of another workspace.
    pub(crate) fn with(
        observations: &'a Observations,
        masks: &'m [Mask],
        indices: Vec<usize>,
        mut rasters: Vec<Raster>,
    ) -> Self {
        rasters.resize_with(indices.len(), || Raster::new(&observations.camera));
        let view = |index: &usize| observations.view(&observations.configurations[*index]);
        Self {
            observations,
            views: indices.iter().map(view).collect(),
            masks: indices.iter().map(|i| &masks[*i]).collect(),
            rasters,
            indices,
        }
    }

    pub(crate) fn refine(&mut self, start: &Start) -> (Refinement, Vec<RefineView<'a>>) {
        refine(self.observations, &self.views, &mut self.rasters, start, CLOSING)
    }

    /// As [`Self::refine`], on some of the views.
    pub(crate) fn refine_some(
        &mut self,
        views: std::ops::Range<usize>,
        start: &Start,
    ) -> (Refinement, Vec<RefineView<'a>>) {
        let rasters = &mut self.rasters[views.clone()];
        refine(self.observations, &self.views[views], rasters, start, CLOSING)
    }

    /// Marks the configurations with a link that the camera sees through, and counts them.
    pub(crate) fn find_misplaced(
        &mut self,
        refinement: &Refinement,
        outcomes: &mut [ConfigurationOutcome],
    ) -> usize {
        let found = self.pixels(&refinement.end());
        let mut count = 0;
        for (index, (_, by_link)) in self.indices.iter().zip(&found) {
            if let Some(misplaced) = misplaced_link(self.observations, by_link) {
                tracing::debug!(configuration = index, ?misplaced, "a link is seen through");
                outcomes[*index].dropped = Some(Dropped::Misplaced(misplaced));
                count += 1;
            }
        }
        count
    }

    /// Where the links are with the joints as `at` has them.
    fn postures(&self, at: &Start) -> Vec<Posture> {
        let moved = |view: &View<'_>| view.posture.moved(&self.observations.arm, &at.joint_offsets);
        self.views.iter().map(moved).collect()
    }

    pub(crate) fn agreement(&mut self, at: &Start) -> Vec<Agreement> {
        self.pixels(at).into_iter().map(|(agreement, _)| agreement).collect()
    }

    /// What the pixels of each view say of the arm at `at`, together and of each link.
    fn pixels(&mut self, at: &Start) -> Vec<(Agreement, Vec<PixelCounts>)> {
        let postures = self.postures(at);
        let views = with_postures(&self.views, &postures, at.depth_factor());
        let pose = &at.camera_from_base;
        agreement(self.observations, &views, &self.masks, &mut self.rasters, pose)
    }

    pub(crate) fn measure(
        &mut self,
        refinement: &Refinement,
        outcomes: &mut [ConfigurationOutcome],
    ) {
        let agreement = self.agreement(&refinement.end());
        for ((index, fit), agreement) in self.indices.iter().zip(&refinement.views).zip(agreement) {
            outcomes[*index].residual_m = fit.surface_m();
            outcomes[*index].agreement = Some(agreement);
        }
    }
}

fn with_postures<'b>(
    views: &[View<'b>],
    postures: &'b [Posture],
    depth_factor: f32,
) -> Vec<View<'b>> {
    let pairs = views.iter().zip(postures);
    pairs.map(|(view, posture)| View { posture, depth_factor, ..*view }).collect()
}
