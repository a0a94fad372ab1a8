//! What each pixel of the posed arm says of its pose.
//!
//! Depth that is missing or wrong contradicts nothing: a pixel speaks against the pose only where it
//! shows what other configurations have shown to be behind the arm, or lies outside the arm's mask.

use super::known_background::{Behind, KnownBackground};
use crate::observations::Observations;
use eyebolt_geometry::Mask;
use eyebolt_registration::{Margin, View};
use eyebolt_render::Raster;

/// Pixels of the posed arm, counted by what they say of its pose.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PixelCounts {
    /// Something was seen at the arm's depth that is not the scene.
    pub agree: usize,
    /// Something was seen at the arm's depth that may as well be the scene.
    pub ambiguous: usize,
    /// The scene behind the arm was seen, also where that is out of range; or they lie outside the
    /// mask.
    pub contradict: usize,
    /// Nothing can be said: hidden, at the outline, without depth, or with a depth that is neither the
    /// arm's nor the scene's.
    pub unknown: usize,
}

impl PixelCounts {
    /// Pixels that say something.
    pub fn judged(&self) -> usize {
        self.agree + self.ambiguous + self.contradict
    }

    /// Share of these that contradict; all if there are none.
    pub fn contradicted_share(&self) -> f64 {
        match self.judged() {
            0 => 1.0,
            judged => self.contradict as f64 / judged as f64,
        }
    }

    pub(super) fn add(&mut self, other: &Self) {
        self.agree += other.agree;
        self.ambiguous += other.ambiguous;
        self.contradict += other.contradict;
        self.unknown += other.unknown;
    }
}

/// Pixels this near to the arm's outline do not contradict: there depth is of either side.
const RIM_PX: u32 = 4;
/// A mask's own edge is trusted this closely, pixels.
const MASK_RIM_PX: u32 = 6;

/// The shadow of what stands before the arm, where stereo and structured light see nothing, is no wider
/// than this share of the image.
const SHADOW: u32 = 25;

/// The counts of each link of the arm drawn in `raster`, which is of view number `own`.
pub(super) fn count_pixels(
    observations: &Observations,
    view: &View<'_>,
    raster: &Raster,
    background: &KnownBackground<'_>,
    own: usize,
) -> Vec<PixelCounts> {
    let drawn = raster.inverse_depth().iter().map(|inverse| *inverse > 0.0).collect();
    let drawn = Mask::new(view.depth.width(), view.depth.height(), drawn);
    let inner = drawn.expect("a raster is of its camera's size").eroded(RIM_PX);
    let mask = view.mask.map(|mask| mask.dilated(MASK_RIM_PX));
    let margin = |z: f32| observations.noise.margin_m(Margin::Refined, z);
    let is_hidden = |at: usize| {
        let (seen, z) = (view.depth_m(at), raster.depth_m(at));
        seen > 0.0 && z.is_some_and(|z| seen < z - margin(z))
    };
    let hidden = (0..view.depth.depth_m().len()).map(is_hidden).collect();
    let hidden = Mask::new(view.depth.width(), view.depth.height(), hidden);
    let hidden = hidden.expect("a pixel each of the image");
    let shadow = hidden.dilated(view.depth.width() / SHADOW);
    let mut counts = vec![PixelCounts::default(); observations.arm.links().len()];
    for at in raster.pixels() {
        let (Some(z), Some(link)) = (raster.depth_m(at), raster.link(at)) else { continue };
        let Some(count) = counts.get_mut(usize::from(link)) else { continue };
        let seen = view.depth_m(at);
        let unseen = hidden.as_slice()[at] || (seen <= 0.0 && shadow.as_slice()[at]);
        let outside = mask.as_ref().is_some_and(|mask| !mask.as_slice()[at]);
        let inside = view.mask.is_some() && !outside;
        let scene = || background.behind(own, at, view.depth.depth_m()[at]) == Behind::Same;
        let at_depth = seen > 0.0 && seen <= z + margin(z);
        let verdict = match (unseen, at_depth) {
            (true, _) => &mut count.unknown,
            _ if outside && inner.as_slice()[at] => &mut count.contradict,
            _ if outside => &mut count.unknown,
            (_, true) if inside || !scene() => &mut count.agree,
            (_, true) => &mut count.ambiguous,
            (_, false) if !inside && inner.as_slice()[at] && scene() => &mut count.contradict,
            (_, false) => &mut count.unknown,
        };
        *verdict += 1;
    }
    counts
}

#[cfg(test)]
mod tests;
