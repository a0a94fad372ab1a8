//! Parts that move with a link and are not in the description: tools, cables, covers.

use crate::observations::Observations;
use eyebolt_geometry::{Base, Link, Mask, Transform};
use eyebolt_registration::{ArmLink, Margin, Start, View};
use nalgebra::{Point3, Vector3};
use std::collections::BTreeMap;

/// Something that moves with a link and is not in the description.
#[derive(Clone, Debug, PartialEq)]
pub struct UnknownPart {
    /// Name of the link.
    pub link: String,
    /// The longest side of the box about it, along the link's axes, metres.
    pub size_m: f64,
}

/// Every how many pixels of the arm one is looked at, along rows and columns.
const STRIDE: usize = 3;
/// Parts are nearer to their link than this, metres.
const REACH_M: f32 = 0.30;
/// Cells of a link's own space in which points are counted, metres: more than depth and pose are off by.
const CELL_M: f32 = 0.02;
/// A cell of a part is seen in so many configurations at least, and in this share of them: on one side of
/// the link it is hidden.
const LEAST_CONFIGURATIONS: usize = 3;
const LEAST_SHARE: f64 = 0.4;
/// Fewer cells are the noise of an edge.
const LEAST_CELLS: usize = 12;

type Cell = (usize, [i32; 3]);

/// The parts that the configurations `used` show when the arm is at `at`, by link; `masks` tell the
/// pixels that are the arm or moved with it.
pub(super) fn unknown_parts(
    observations: &Observations,
    masks: &[Mask],
    used: &[usize],
    at: &Start,
) -> Vec<UnknownPart> {
    let mut seen: BTreeMap<Cell, usize> = BTreeMap::new();
    for index in used {
        let mut cells = beside(observations, &masks[*index], *index, at);
        cells.sort_unstable();
        cells.dedup();
        for cell in cells {
            *seen.entry(cell).or_default() += 1;
        }
    }
    let least = ((LEAST_SHARE * used.len() as f64).ceil() as usize).max(LEAST_CONFIGURATIONS);
    let links = observations.arm.links().iter().enumerate();
    let part = |(link, model): (usize, &ArmLink)| {
        let of_link = seen.range((link, [i32::MIN; 3])..(link + 1, [i32::MIN; 3]));
        let cells: Vec<[i32; 3]> =
            of_link.filter(|(_, count)| **count >= least).map(|((_, cell), _)| *cell).collect();
        let extent = |axis: usize| {
            let along = || cells.iter().map(|cell| cell[axis]);
            along().max().zip(along().min()).map_or(0, |(high, low)| high - low + 1)
        };
        let size_m =
            (0..3).map(extent).max().map_or(0.0, |side| f64::from(CELL_M) * f64::from(side));
        (cells.len() >= LEAST_CELLS).then(|| UnknownPart { link: model.name.clone(), size_m })
    };
    links.filter_map(part).collect()
}

/// Cells of points that are beside the posed arm in one configuration.
fn beside(observations: &Observations, mask: &Mask, index: usize, at: &Start) -> Vec<Cell> {
    let configuration = &observations.configurations[index];
    let view = View { depth_factor: at.depth_factor(), ..observations.view(configuration) };
    let posture = configuration.posture.moved(&observations.arm, &at.joint_offsets);
    let base_from_camera = at.camera_from_base.inverse().isometry().cast::<f32>();
    // Clear of the outline, where pixels mix arm and scene.
    let mask = mask.eroded(STRIDE as u32);
    let (width, height) = (mask.width() as usize, mask.height() as usize);
    let link_from_base: Vec<Transform<Link, Base>> =
        posture.base_from_link().iter().map(Transform::inverse).collect();
    let (mut cells, mut last) = (Vec::new(), 0);
    for v in (0..height).step_by(STRIDE) {
        for u in (0..width).step_by(STRIDE) {
            let pixel = v * width + u;
            let z = view.depth_m(pixel);
            if !mask.as_slice()[pixel] || z <= 0.0 {
                continue;
            }
            let point = base_from_camera * observations.rays.point(pixel, z);
            let Some(nearest) = posture.nearest_within(&observations.arm, &point, REACH_M, last)
            else {
                continue;
            };
            last = nearest.link;
            if nearest.distance_m > Margin::Refined.at_m(z) {
                cells.push((nearest.link, cell(&link_from_base[nearest.link], &point)));
            }
        }
    }
    cells
}

fn cell(link_from_base: &Transform<Link, Base>, point_in_base: &Point3<f32>) -> [i32; 3] {
    let in_link: Vector3<f64> = link_from_base.point(&point_in_base.cast()).coords;
    in_link.map(|x| (x / f64::from(CELL_M)).floor() as i32).into()
}
