//! Frames of one arm configuration, merged.

use eyebolt_geometry::{DepthImage, Mask};
use rayon::prelude::*;

/// Median depth of each pixel over `images` of one size; 0 where fewer than half saw anything.
pub(crate) fn median_depth(images: &[DepthImage]) -> Option<DepthImage> {
    let (first, rest) = images.split_first()?;
    if rest.is_empty() {
        return Some(first.clone());
    }
    let depths: Vec<&[f32]> = images.iter().map(DepthImage::depth_m).collect();
    let mut depth_m = vec![0.0; first.depth_m().len()];
    depth_m.par_chunks_mut(MEDIAN_BLOCK).enumerate().for_each(|(block, medians)| {
        let mut seen = Vec::with_capacity(depths.len());
        for (offset, median) in medians.iter_mut().enumerate() {
            let at = block * MEDIAN_BLOCK + offset;
            seen.clear();
            seen.extend(depths.iter().filter_map(|depth| depth.get(at)).filter(|z| **z > 0.0));
            if !seen.is_empty() && 2 * seen.len() >= depths.len() {
                let middle = seen.len() / 2;
                *median = *seen.select_nth_unstable_by(middle, f32::total_cmp).1;
            }
        }
    });
    DepthImage::new(first.width(), first.height(), depth_m).ok()
}

/// Pixels that one task takes the median of.
const MEDIAN_BLOCK: usize = 4096;

/// Pixels in more than half of `masks` of one size; `None` unless there is a mask for each frame.
pub(crate) fn common_mask(masks: &[Option<Mask>]) -> Option<Mask> {
    let masks: Vec<&Mask> = masks.iter().map(Option::as_ref).collect::<Option<_>>()?;
    let first = masks.first()?;
    let votes = |at: usize| masks.iter().filter(|mask| mask.as_slice()[at]).count();
    let set = (0..first.as_slice().len()).map(|at| 2 * votes(at) > masks.len()).collect();
    Mask::new(first.width(), first.height(), set).ok()
}
