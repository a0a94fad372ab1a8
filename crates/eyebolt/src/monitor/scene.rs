//! Camera or base: the scene behind the arm moves with the one and not with the other.

use eyebolt_geometry::{Camera, DepthImage, PinholeCamera, RayTable, Transform};
use eyebolt_registration::Margin;
use eyebolt_render::Raster;

/// Every how many pixels one is looked at, along rows and columns.
const STRIDE: usize = 4;
/// Pixels this near to the posed arm are not of the scene.
const ARM_PX: u32 = 12;
/// Fewer pixels of the scene tell nothing.
const LEAST: usize = 300;
/// By how much the one has to explain the scene better, in margins for each pixel.
const CLEARLY: f64 = 0.02;

/// The scene as it was before.
#[derive(Clone, Debug)]
pub(super) struct Scene {
    /// Metres; 0 where nothing was seen, or the arm.
    depth_m: Vec<f32>,
}

/// What moved, as the scene has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Witness {
    Camera,
    Base,
    Silent,
}

impl Scene {
    pub fn empty(camera: &PinholeCamera) -> Self {
        Self { depth_m: vec![0.0; camera.pixel_count()] }
    }

    /// Remembers what is seen away from the arm, as `raster` has it, where nothing is known yet.
    pub fn remember(&mut self, depth: &DepthImage, raster: &Raster) {
        let near = near_arm(raster);
        for (at, known) in self.depth_m.iter_mut().enumerate() {
            let seen = depth.depth_m().get(at).copied().unwrap_or(0.0);
            if *known <= 0.0 && near.get(at) == Some(&false) {
                *known = seen;
            }
        }
    }

    /// Whether `depth` shows the scene from where the camera was, or from where it is if it moved by
    /// `after_from_before`.
    pub fn witness(
        &self,
        camera: &PinholeCamera,
        rays: &RayTable,
        (depth, raster): (&DepthImage, &Raster),
        after_from_before: &Transform<Camera, Camera>,
    ) -> Witness {
        let (width, height) = (camera.width() as usize, camera.height() as usize);
        let near = near_arm(raster);
        let moved = after_from_before.isometry().cast::<f32>();
        let off = |pixel: Option<(u32, u32)>, z: f32| -> Option<f64> {
            let (u, v) = pixel?;
            let at = v as usize * width + u as usize;
            let seen = depth.depth_m().get(at).copied().filter(|seen| *seen > 0.0)?;
            (near.get(at) == Some(&false))
                .then(|| f64::from(((seen - z) / Margin::Refined.at_m(z)).abs().min(1.0)))
        };
        let (mut stayed, mut went, mut count) = (0.0, 0.0, 0_usize);
        for v in (0..height).step_by(STRIDE) {
            for u in (0..width).step_by(STRIDE) {
                let at = v * width + u;
                let Some(z) = self.depth_m.get(at).copied().filter(|z| *z > 0.0) else { continue };
                let point = moved * rays.point(at, z);
                let there = camera.project(&point.cast()).filter(|pixel| camera.contains(pixel));
                let there = there.map(|pixel| ((pixel.x + 0.5) as u32, (pixel.y + 0.5) as u32));
                let pair = (off(Some((u as u32, v as u32)), z), off(there, point.z));
                if let (Some(if_stayed), Some(if_went)) = pair {
                    stayed += if_stayed;
                    went += if_went;
                    count += 1;
                }
            }
        }
        let clearly = CLEARLY * f64::from(u32::try_from(count).unwrap_or(u32::MAX));
        match stayed - went {
            _ if count < LEAST => Witness::Silent,
            better if better > clearly => Witness::Camera,
            better if better < -clearly => Witness::Base,
            _ => Witness::Silent,
        }
    }
}

fn near_arm(raster: &Raster) -> Vec<bool> {
    let drawn = raster.inverse_depth().iter().map(|inverse| *inverse > 0.0).collect();
    let (width, height) = (raster.width() as u32, raster.height() as u32);
    let mask = eyebolt_geometry::Mask::new(width, height, drawn);
    mask.map_or_else(|_| Vec::new(), |mask| mask.dilated(ARM_PX).as_slice().to_vec())
}
