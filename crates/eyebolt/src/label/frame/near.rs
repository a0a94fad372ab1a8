//! How far what was seen is from the posed arm.

use super::outline::Outline;
use eyebolt_geometry::{Base, Camera, DepthImage, RayTable, Transform};
use eyebolt_registration::{ArmModel, Label, Posture};

/// Farther from the arm than this nothing is part of it, or of what is mounted on it, metres.
const FAR_M: f32 = 0.15;

/// Distance and part of the arm nearest to what each pixel of an outline's rectangle saw.
#[derive(Debug)]
pub(super) struct Near {
    distance_m: Vec<f32>,
    label: Vec<Label>,
}

impl Near {
    pub(super) fn new(
        arm: &ArmModel,
        posture: &Posture,
        rays: &RayTable,
        depth: &DepthImage,
        camera_from_base: &Transform<Camera, Base>,
        outline: &Outline,
    ) -> Self {
        let base_from_camera = camera_from_base.inverse().isometry().cast::<f32>();
        let (mut distance_m, mut label) = (Vec::new(), Vec::new());
        let mut last = 0;
        for at in outline.pixels() {
            let z = depth.depth_m()[at];
            let point = base_from_camera * rays.point(at, z);
            let usable = z > 0.0 && !point.x.is_nan();
            let nearest =
                usable.then(|| posture.nearest_within(arm, &point, FAR_M, last)).flatten();
            last = nearest.map_or(last, |nearest| nearest.link);
            distance_m.push(nearest.map_or(f32::INFINITY, |nearest| nearest.distance_m));
            label.push(match nearest {
                None => Label::Background,
                Some(nearest) if arm.is_end_effector(nearest.link) => Label::EndEffector,
                Some(_) => Label::Arm,
            });
        }
        Self { distance_m, label }
    }

    /// Signed distance from the arm at `place` of the outline's pixels, metres; infinite where
    /// nothing of it is near.
    pub(super) fn distance_m(&self, place: usize) -> f32 {
        self.distance_m[place]
    }

    /// Which part of the arm is nearest; background where none is near.
    pub(super) fn label(&self, place: usize) -> Label {
        self.label[place]
    }
}
