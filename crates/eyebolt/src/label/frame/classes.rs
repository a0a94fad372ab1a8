//! What each pixel shows, as the drawn arm, the scene behind it and the depth have it.

use super::backdrop::Backdrop;
use super::near::Near;
use super::outline::Outline;
use crate::depth_noise::DepthNoise;
use eyebolt_geometry::DepthImage;
use eyebolt_registration::{Label, Margin};
use eyebolt_render::Raster;

/// Poses, joints and shapes are off by about a pixel: nearer to an outline it is not known on which
/// side of it a pixel is.
const EDGE_PX: f32 = 1.0;
/// What is this near to the arm without being of it may be mounted on it, metres.
const MOUNTED_M: f32 = 0.10;

/// Everything that a frame's labels are decided by.
pub(super) struct Judge<'a> {
    pub(super) noise: &'a DepthNoise,
    pub(super) backdrop: &'a Backdrop,
    pub(super) outline: &'a Outline,
    pub(super) raster: &'a Raster,
    pub(super) near: &'a Near,
    /// Whether the outline is that of a mask.
    pub(super) masked: bool,
}

impl Judge<'_> {
    /// The label of every pixel of the image.
    pub(super) fn labels(&self, depth: &DepthImage) -> Vec<Label> {
        let plain = |z: &f32| if *z > 0.0 { Label::Background } else { Label::Ignore };
        let mut labels: Vec<Label> = depth.depth_m().iter().map(plain).collect();
        for (place, at) in self.outline.pixels().enumerate() {
            let z = depth.depth_m()[at];
            if z > 0.0 {
                labels[at] = self.label(place, at, z);
            }
        }
        labels
    }

    /// That of a pixel of the rectangle with depth.
    fn label(&self, place: usize, at: usize, z: f32) -> Label {
        let inside_px = self.outline.inside_px(place);
        if inside_px > EDGE_PX {
            self.on_arm(place, at, z)
        } else if inside_px < -EDGE_PX {
            self.beside_arm(place, at, z)
        } else {
            Label::Ignore
        }
    }

    /// Of a pixel where the arm is drawn.
    fn on_arm(&self, place: usize, at: usize, z: f32) -> Label {
        let (drawn, near) = (self.outline.label(place), self.near.label(place));
        let distance_m = self.near.distance_m(place);
        if distance_m.abs() <= self.surface_m(z) {
            let along_ray =
                self.raster.depth_m(at).is_some_and(|m| (z - m).abs() <= self.surface_m(z));
            return match drawn {
                // Marked by a mask and not drawn, or drawn as both.
                Label::Ignore => near,
                drawn if self.outline.to_other_class_px(place) <= EDGE_PX => {
                    if near == drawn && !along_ray { drawn } else { Label::Ignore }
                }
                drawn if along_ray || near == drawn => drawn,
                _ => Label::Ignore,
            };
        }
        let hidden = self.raster.depth_m(at).is_some_and(|m| z < m) && !self.masked;
        let is_clear = distance_m > Margin::Beside.at_m(z).max(MOUNTED_M);
        if hidden && is_clear { Label::Background } else { Label::Ignore }
    }

    /// Of a pixel where it is not.
    fn beside_arm(&self, place: usize, at: usize, z: f32) -> Label {
        if self.masked || self.backdrop.explains(at, z, self.noise) {
            return Label::Background;
        }
        let distance_m = self.near.distance_m(place);
        let is_before = self.backdrop.nearest_m(at).is_none_or(|behind_m| z < behind_m);
        if is_before && distance_m < MOUNTED_M.max(self.surface_m(z)) {
            return Label::Ignore;
        }
        Label::Background
    }

    /// How far from the posed surface depth of the arm may be, metres.
    pub(super) fn surface_m(&self, z: f32) -> f32 {
        self.noise.margin_m(Margin::Label, z)
    }
}
