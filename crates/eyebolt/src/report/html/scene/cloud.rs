//! What the camera saw in one configuration, thinned.

use super::quantised::Bounds;
use super::rows::rows;
use crate::observations::Configuration;
use crate::report::html::base64;
use crate::report::seen::Points;
use eyebolt_registration::{Label, Posture};
use serde::Serialize;

/// A configuration for the page.
#[derive(Debug, Serialize)]
pub(super) struct Cloud {
    name: String,
    dropped: bool,
    count: usize,
    points: String,
    /// 0 background, 1 arm, 2 nobody can say.
    labels: String,
    /// How far behind the arm's surface; -128 where that is not near.
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
        let behind = seen.behind_mm.iter().map(|mm| whole_millimetres(*mm));
        let behind_mm: Vec<u8> = behind.flat_map(i8::to_le_bytes).collect();
        let labels: Vec<u8> = seen.labels.iter().map(|label| code(*label)).collect();
        Self {
            name: configuration.frames.first().cloned().unwrap_or_default(),
            dropped,
            count: seen.points.len(),
            points: bounds.encode(&seen.points),
            labels: base64::encode(&labels),
            behind_mm: base64::encode(&behind_mm),
            links: posture.base_from_link().iter().map(rows).collect(),
        }
    }
}

fn code(label: Label) -> u8 {
    match label {
        Label::Background => 0,
        Label::Arm | Label::EndEffector => 1,
        Label::Ignore => 2,
    }
}

fn whole_millimetres(mm: f32) -> i8 {
    if mm.is_nan() { i8::MIN } else { mm.clamp(-127.0, 127.0).round() as i8 }
}
