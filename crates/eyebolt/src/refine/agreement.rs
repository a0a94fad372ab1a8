//! How well a pose explains what was seen, counted in pixels.

use super::known_background::KnownBackground;
use super::pixels::{PixelCounts, count_pixels};
use crate::observations::Observations;
use eyebolt_geometry::{Base, Camera, Mask, Transform};
use eyebolt_registration::{Margin, View};
use eyebolt_render::Raster;
use rayon::prelude::*;

/// Pixels of one configuration, counted by what they say of a pose.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Agreement {
    /// Pixels of the posed arm.
    pub pixels: PixelCounts,
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
        self.pixels.judged() > 0
    }

    /// Share of the posed arm's pixels that are contradicted, of those that can be judged; all if
    /// none can.
    pub fn contradicted_share(&self) -> f64 {
        self.pixels.contradicted_share()
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
        let mut pixels = self.pixels;
        pixels.add(&other.pixels);
        Self {
            pixels,
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
/// pixels are the arm; and what the pixels of each link say.
pub fn agreement(
    observations: &Observations,
    views: &[View<'_>],
    masks: &[&Mask],
    rasters: &mut [Raster],
    camera_from_base: &Transform<Camera, Base>,
) -> Vec<(Agreement, Vec<PixelCounts>)> {
    views.par_iter().zip(rasters.par_iter_mut()).for_each(|(view, raster)| {
        raster.draw(view.camera, &view.posture.meshes(&observations.arm, camera_from_base));
    });
    let background = KnownBackground::new(observations, views, rasters);
    let work = views.par_iter().zip(masks).zip(rasters.par_iter()).enumerate();
    work.map(|(own, ((view, mask), raster))| {
        let by_link = count_pixels(observations, view, raster, &background, own);
        let mut pixels = PixelCounts::default();
        by_link.iter().for_each(|link| pixels.add(link));
        let mut counts = Agreement { pixels, ..Agreement::default() };
        (counts.explained, counts.unexplained) =
            arm_pixels(observations, view, mask, camera_from_base);
        if let Some(mask) = view.mask {
            let drawn = raster.pixels().count();
            counts.overlap = raster.pixels().filter(|at| mask.as_slice()[*at]).count();
            counts.union = drawn + mask.count() - counts.overlap;
        }
        (counts, by_link)
    })
    .collect()
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
            let z = view.depth_m(at);
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
