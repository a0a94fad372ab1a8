//! Frames of one arm configuration, merged.

use eyebolt_geometry::{DepthImage, Mask};
use eyebolt_robot::LinkPoses;
use rayon::prelude::*;

/// Frames whose links are this near to each other show the same configuration: more than encoders
/// at rest make of it, less than anyone moves an arm on purpose.
const SAME_M: f64 = 5e-3;
const SAME_RAD: f64 = 1e-2;

/// Whether two frames have the arm in the same place; both are of the same robot.
///
/// The links decide, not the joints: a recording may hold joints of other things.
pub(crate) fn same_place(a: &LinkPoses, b: &LinkPoses) -> bool {
    a.iter().zip(b).all(|pair| match pair {
        (Some(a), Some(b)) => {
            let (metres, radians) = a.distance_to(b);
            metres <= SAME_M && radians <= SAME_RAD
        }
        (None, None) => true,
        _ => false,
    })
}

/// Median depth of each pixel over `images` of one size; 0 where fewer than half saw anything.
pub(crate) fn median_depth(images: &[DepthImage]) -> Option<DepthImage> {
    let (first, rest) = images.split_first()?;
    if rest.is_empty() {
        return Some(first.clone());
    }
    let depth = |at: usize| {
        let mut seen: Vec<f32> =
            images.iter().filter_map(|image| image.depth_m().get(at).copied()).collect();
        seen.retain(|z| *z > 0.0);
        if 2 * seen.len() < images.len() || seen.is_empty() {
            return 0.0;
        }
        let middle = seen.len() / 2;
        *seen.select_nth_unstable_by(middle, f32::total_cmp).1
    };
    let depth_m = (0..first.depth_m().len()).into_par_iter().map(depth).collect();
    DepthImage::new(first.width(), first.height(), depth_m).ok()
}

/// Pixels in more than half of `masks` of one size; `None` unless there is a mask for each frame.
pub(crate) fn common_mask(masks: &[Option<Mask>]) -> Option<Mask> {
    let masks: Vec<&Mask> = masks.iter().map(Option::as_ref).collect::<Option<_>>()?;
    let first = masks.first()?;
    let votes = |at: usize| masks.iter().filter(|mask| mask.as_slice()[at]).count();
    let set = (0..first.as_slice().len()).map(|at| 2 * votes(at) > masks.len()).collect();
    Mask::new(first.width(), first.height(), set).ok()
}
