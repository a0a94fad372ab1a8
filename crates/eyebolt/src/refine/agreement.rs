//! How well a pose explains what was seen, counted in pixels.

use crate::observations::Observations;
use eyebolt_geometry::{Base, Camera, Mask, Transform};
use eyebolt_registration::{Margin, View};
use eyebolt_render::Raster;
use rayon::prelude::*;

/// Pixels of one configuration, counted by what they say of a pose.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Agreement {
    /// Pixels of the posed arm where something was seen at its depth.
    pub agree: usize,
    /// Pixels of the posed arm that the camera saw through, or that lie outside the mask.
    pub contradict: usize,
    /// Pixels of the posed arm where nothing can be said: hidden, or without depth.
    pub unknown: usize,
    /// Pixels known to be the arm that lie on the posed arm's surface, of those looked at: every other
    /// one of every other row.
    pub explained: usize,
    /// Those looked at that do not.
    pub unexplained: usize,
    /// Pixels of both the posed arm and the mask that the recording has.
    pub overlap: usize,
    /// Pixels of either.
    pub union: usize,
}

/// Every how many pixels of a mask one is looked at, along rows and columns.
const STRIDE: usize = 2;

impl Agreement {
    /// Whether anything of the posed arm could be judged at all.
    pub fn is_in_view(&self) -> bool {
        self.agree + self.contradict > 0
    }

    /// Share of the posed arm's pixels that are contradicted, of those that can be judged; all if
    /// none can.
    pub fn contradicted_share(&self) -> f64 {
        share(self.contradict, self.agree)
    }

    /// Share of the arm's pixels that the posed arm does not explain.
    pub fn unexplained_share(&self) -> f64 {
        share(self.unexplained, self.explained)
    }

    /// Intersection over union of the posed arm's silhouette and the masks of the recording; `None`
    /// without masks.
    pub fn silhouette_iou(&self) -> Option<f64> {
        (self.union > 0).then(|| self.overlap as f64 / self.union as f64)
    }

    /// All counts added up.
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            agree: self.agree + other.agree,
            contradict: self.contradict + other.contradict,
            unknown: self.unknown + other.unknown,
            explained: self.explained + other.explained,
            unexplained: self.unexplained + other.unexplained,
            overlap: self.overlap + other.overlap,
            union: self.union + other.union,
        }
    }
}

fn share(part: usize, rest: usize) -> f64 {
    match part + rest {
        0 => 1.0,
        whole => part as f64 / whole as f64,
    }
}

/// The agreement of each of `views` with the arm posed at `camera_from_base`, `masks` saying which
/// pixels are the arm.
pub fn agreement(
    observations: &Observations,
    views: &[View<'_>],
    masks: &[&Mask],
    rasters: &mut [Raster],
    camera_from_base: &Transform<Camera, Base>,
) -> Vec<Agreement> {
    let work = views.par_iter().zip(masks).zip(rasters.par_iter_mut());
    work.map(|((view, mask), raster)| {
        raster.draw(view.camera, &view.posture.meshes(&observations.arm, camera_from_base));
        let mut counts = model_pixels(view, raster);
        (counts.explained, counts.unexplained) =
            arm_pixels(observations, view, mask, camera_from_base);
        if let Some(mask) = view.mask {
            let drawn = raster.pixels().count();
            counts.overlap = raster.pixels().filter(|at| mask.as_slice()[*at]).count();
            counts.union = drawn + mask.count() - counts.overlap;
        }
        counts
    })
    .collect()
}

fn model_pixels(view: &View<'_>, raster: &Raster) -> Agreement {
    let mut counts = Agreement::default();
    for at in raster.pixels() {
        let Some(z) = raster.depth_m(at) else { continue };
        let seen = view.depth.depth_m()[at];
        if seen > 0.0 && seen < z - Margin::Refined.at_m(z) {
            counts.unknown += 1;
        } else if view.mask.is_some_and(|mask| !mask.as_slice()[at]) {
            counts.contradict += 1;
        } else if seen <= 0.0 {
            counts.unknown += 1;
        } else if seen > z + Margin::Refined.at_m(z) {
            counts.contradict += 1;
        } else {
            counts.agree += 1;
        }
    }
    counts
}

fn arm_pixels(
    observations: &Observations,
    view: &View<'_>,
    mask: &Mask,
    camera_from_base: &Transform<Camera, Base>,
) -> (usize, usize) {
    let pose = camera_from_base.inverse().isometry().cast::<f32>();
    let (width, height) = (view.depth.width() as usize, view.depth.height() as usize);
    let (mut explained, mut unexplained, mut last) = (0, 0, 0);
    for v in (0..height).step_by(STRIDE) {
        for u in (0..width).step_by(STRIDE) {
            let at = v * width + u;
            let z = view.depth.depth_m()[at];
            if !mask.as_slice()[at] || z <= 0.0 {
                continue;
            }
            let point = pose * observations.rays.point(at, z);
            let limit = Margin::Refined.at_m(z);
            match view.posture.nearest_within(&observations.arm, &point, limit, last) {
                Some(nearest) if nearest.distance_m > -limit => {
                    last = nearest.link;
                    explained += 1;
                }
                _ => unexplained += 1,
            }
        }
    }
    (explained, unexplained)
}

/// All views' counts together.
pub fn total(views: &[Agreement]) -> Agreement {
    views.iter().fold(Agreement::default(), |sum, view| sum.plus(view))
}
