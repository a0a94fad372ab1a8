//! What the camera saw in one configuration, thinned.

use super::quantised::Bounds;
use super::rows::rows;
use crate::observations::{Configuration, Observations};
use crate::report::html::base64;
use crate::report::html::leftovers::Leftover;
use eyebolt_registration::{Label, Posture, Refinement};
use nalgebra::Point3;
use serde::Serialize;

/// Points of all configurations of a page together, and of one.
const MOST_POINTS: usize = 240_000;
const MOST_POINTS_OF_ONE: usize = 40_000;
/// Share of the points that is kept for the arm.
const ARM_SHARE: f64 = 0.5;
/// What is farther from the arm's surface than this has no residual, metres.
const NEAR_M: f32 = 0.06;
/// Nor is it drawn beyond this, in distances of the camera from the base.
const FARTHEST: f64 = 1.4;

/// Points of one configuration at most, of `count`.
pub(super) fn most_points(count: usize) -> usize {
    (MOST_POINTS / count.max(1)).min(MOST_POINTS_OF_ONE)
}

/// Points seen, with what is known of each.
#[derive(Debug, Default)]
pub(super) struct Points {
    /// Base frame, metres.
    pub(super) points: Vec<Point3<f32>>,
    /// 0 background, 1 arm, 2 nobody can say.
    labels: Vec<u8>,
    /// How far behind the arm's surface, millimetres; -128 where that is not near.
    behind_mm: Vec<i8>,
}

/// A configuration for the page.
#[derive(Debug, Serialize)]
pub(super) struct Cloud {
    name: String,
    dropped: bool,
    count: usize,
    points: String,
    labels: String,
    behind_mm: String,
    /// `base_from_link` of every link.
    links: Vec<[f32; 12]>,
}

impl Cloud {
    pub(super) fn new(
        configuration: &Configuration,
        posture: &Posture,
        seen: &Points,
        bounds: &Bounds,
        dropped: bool,
    ) -> Self {
        let behind_mm: Vec<u8> = seen.behind_mm.iter().flat_map(|mm| mm.to_le_bytes()).collect();
        Self {
            name: configuration.frames.first().cloned().unwrap_or_default(),
            dropped,
            count: seen.points.len(),
            points: bounds.encode(&seen.points),
            labels: base64::encode(&seen.labels),
            behind_mm: base64::encode(&behind_mm),
            links: posture.base_from_link().iter().map(rows).collect(),
        }
    }
}

/// About `most` of the points of a configuration, those of the arm more densely than the rest.
///
/// Depth is scaled by what fits best, as in the refinement.
pub(super) fn seen(
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
            seen.labels.push(code(label));
            seen.behind_mm.push(nearest.map_or(i8::MIN, |n| millimetres(-n.distance_m)));
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

fn code(label: Label) -> u8 {
    match label {
        Label::Background => 0,
        Label::Arm | Label::EndEffector => 1,
        Label::Ignore => 2,
    }
}

fn millimetres(metres: f32) -> i8 {
    (1e3 * metres).clamp(-127.0, 127.0).round() as i8
}
