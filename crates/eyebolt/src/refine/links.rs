//! Links that are not where the joints put them.

use super::pixels::PixelCounts;
use crate::observations::Observations;

/// A link that the camera sees through.
#[derive(Clone, Debug, PartialEq)]
pub struct Misplaced {
    /// Name of the link.
    pub link: String,
    /// Share of its pixels that say something where the scene behind it is seen.
    pub share: f64,
}

/// Links with fewer pixels than this share of the image are not judged.
const LEAST_PIXELS: f64 = 6e-4;
/// Of a link in its place hardly a pixel shows the scene, its rim apart; of glossy ones before a scene
/// out of range a fifth.
const LARGEST_SHARE: f64 = 0.30;

/// The link that is seen through most, if any is more than can be, from what the pixels of each link
/// say in one view.
pub fn misplaced_link(observations: &Observations, by_link: &[PixelCounts]) -> Option<Misplaced> {
    let least = (LEAST_PIXELS * observations.camera.pixel_count() as f64) as usize;
    let links = observations.arm.links().iter().zip(by_link);
    links
        .filter(|(_, counts)| counts.judged() >= least.max(1))
        .map(|(link, counts)| Misplaced {
            link: link.name.clone(),
            share: counts.contradicted_share(),
        })
        .filter(|misplaced| misplaced.share > LARGEST_SHARE)
        .max_by(|a, b| a.share.total_cmp(&b.share))
}
