//! What the camera saw in one configuration, thinned, each point with its distance from the posed arm.

use super::leftovers::Leftover;
use crate::observations::{Configuration, Observations};
use eyebolt_registration::{Label, Posture, Refinement};
use nalgebra::Point3;
use rayon::prelude::*;

/// Points of all configurations together, and of one.
const MOST_POINTS: usize = 240_000;
const MOST_POINTS_OF_ONE: usize = 40_000;
/// Share of the points that is kept for the arm.
const ARM_SHARE: f64 = 0.5;
/// What is farther from the arm's surface than this has no residual, metres.
const NEAR_M: f32 = 0.06;
/// Nor is it drawn beyond this, in distances of the camera from the base.
const FARTHEST: f64 = 1.4;

/// Points seen, with what is known of each.
#[derive(Debug, Default)]
pub(super) struct Points {
    /// Base frame, metres.
    pub(super) points: Vec<Point3<f32>>,
    pub(super) labels: Vec<Label>,
    /// How far behind the arm's surface, millimetres; NaN where that is not near.
    pub(super) behind_mm: Vec<f32>,
}

/// The points of every configuration, of which there is a posture and what is left over.
pub(super) fn all_seen(
    observations: &Observations,
    postures: &[Posture],
    refinement: &Refinement,
    leftovers: &[Leftover],
) -> Vec<Points> {
    let most = (MOST_POINTS / observations.configurations.len().max(1)).min(MOST_POINTS_OF_ONE);
    let work = observations.configurations.par_iter().zip(postures).zip(leftovers);
    work.map(|((configuration, posture), leftover)| {
        seen(observations, configuration, posture, refinement, leftover, most)
    })
    .collect()
}

/// About `most` of the points of a configuration, those of the arm more densely than the rest.
///
/// Depth is scaled by what fits best, as in the refinement.
fn seen(
    observations: &Observations,
    configuration: &Configuration,
    posture: &Posture,
    refinement: &Refinement,
    leftover: &Leftover,
    most: usize,
) -> Points {
    let labels = &leftover.labels;
    let base_from_camera = refinement.camera_from_base.inverse();
    let pose = base_from_camera.isometry().cast::<f32>();
    let farthest_m = (FARTHEST * base_from_camera.translation_m().norm()).max(1.0) as f32;
    let scale = (1.0 + refinement.depth_scale()) as f32;
    let (width, height) = (configuration.depth.width(), configuration.depth.height());
    let on_arm = labels.count(Label::Arm) + labels.count(Label::EndEffector);
    let strides = strides(on_arm, (width * height) as usize, most);
    let (mut seen, mut last) = (Points::default(), 0);
    for v in 0..height as usize {
        for u in 0..width as usize {
            let label = labels.at(u, v).unwrap_or(Label::Background);
            let stride = if label == Label::Background { strides.rest } else { strides.arm };
            let z = configuration.depth.at(u as u32, v as u32) * scale;
            if !(u.is_multiple_of(stride) && v.is_multiple_of(stride) && z > 0.0) {
                continue;
            }
            let point = pose * observations.rays.point(v * width as usize + u, z);
            let away_m = point.coords.norm();
            if away_m.is_nan() || away_m > farthest_m {
                continue;
            }
            let nearest = posture.nearest_within(&observations.arm, &point, NEAR_M, last);
            last = nearest.map_or(last, |nearest| nearest.link);
            seen.points.push(point);
            seen.labels.push(label);
            seen.behind_mm.push(nearest.map_or(f32::NAN, |n| -1e3 * n.distance_m));
        }
    }
    seen
}

struct Strides {
    arm: usize,
    rest: usize,
}

/// Every how many pixels one is kept along rows and columns.
fn strides(on_arm: usize, pixels: usize, most: usize) -> Strides {
    let stride = |pixels: usize, most: f64| ((pixels as f64 / most).sqrt().ceil() as usize).max(1);
    let for_arm = (ARM_SHARE * most as f64).max(1.0);
    let arm = stride(on_arm, for_arm);
    let rest = stride(pixels.saturating_sub(on_arm), (most as f64 - for_arm).max(1.0));
    Strides { arm, rest: rest.max(arm) }
}
