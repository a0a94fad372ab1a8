//! Links that are not where the joints put them.

use crate::observations::Observations;
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::{Margin, View};
use eyebolt_render::Raster;
use rayon::prelude::*;

/// A link that the camera sees through.
#[derive(Clone, Debug, PartialEq)]
pub struct Misplaced {
    /// Name of the link.
    pub link: String,
    /// Share of its pixels with depth where something lies clearly behind it.
    pub share: f64,
}

/// Links with fewer pixels than this share of the image are not judged.
const LEAST_PIXELS: f64 = 6e-4;
/// A link in its place is seen through at its rim only: some 5 % of its pixels.
const LARGEST_SHARE: f64 = 0.15;

/// For each of `views` the link that is seen through most, if any is more than its rim explains.
///
/// What stands before a link hides it and says nothing.
pub fn misplaced_links(
    observations: &Observations,
    views: &[View<'_>],
    rasters: &mut [Raster],
    camera_from_base: &Transform<Camera, Base>,
) -> Vec<Option<Misplaced>> {
    let least = (LEAST_PIXELS * observations.camera.pixel_count() as f64) as usize;
    let pairs = views.par_iter().zip(rasters.par_iter_mut());
    pairs
        .map(|(view, raster)| {
            raster.draw(view.camera, &view.posture.meshes(&observations.arm, camera_from_base));
            let links =
                observations.arm.links().iter().zip(seen_through(observations, view, raster));
            links
                .filter(|(_, (through, judged))| *judged >= least.max(1) && *through > 0)
                .map(|(link, (through, judged))| Misplaced {
                    link: link.name.clone(),
                    share: through as f64 / judged as f64,
                })
                .filter(|misplaced| misplaced.share > LARGEST_SHARE)
                .max_by(|a, b| a.share.total_cmp(&b.share))
        })
        .collect()
}

/// For each link its pixels that are seen through, and all that are not hidden.
fn seen_through(
    observations: &Observations,
    view: &View<'_>,
    raster: &Raster,
) -> Vec<(usize, usize)> {
    let mut counts = vec![(0, 0); observations.arm.links().len()];
    for at in raster.pixels() {
        let (Some(z), Some(link)) = (raster.depth_m(at), raster.link(at)) else { continue };
        let seen = view.depth.depth_m()[at];
        let tolerance = Margin::SeenThrough.at_m(z);
        if seen > z - tolerance && seen > 0.0 {
            let (through, judged) = &mut counts[link as usize];
            *through += usize::from(seen > z + tolerance);
            *judged += 1;
        }
    }
    counts
}
