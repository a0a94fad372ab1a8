//! Frames of one arm configuration, merged.

use eyebolt_geometry::{DepthImage, Mask};
use eyebolt_robot::JointPositions;
use rayon::prelude::*;

/// Frames whose joints differ by no more than this show the same configuration: 0.2 degrees, or
/// as many millimetres as that moves at an arm's length (3 mm) for sliding joints.
const SAME_JOINTS: f64 = 3.5e-3;

/// Indices of the frames of each configuration, in order of appearance.
///
/// A frame joins the first configuration whose first frame has the same joints.
pub(crate) fn group(joints: &[&JointPositions]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (index, positions) in joints.iter().enumerate() {
        let known = groups.iter_mut().find(|group| same(joints[group[0]], positions));
        match known {
            Some(group) => group.push(index),
            None => groups.push(vec![index]),
        }
    }
    groups
}

fn same(a: &JointPositions, b: &JointPositions) -> bool {
    a.len() == b.len()
        && a.iter().all(|(name, value)| {
            b.get(name).is_some_and(|other| (value - other).abs() <= SAME_JOINTS)
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
