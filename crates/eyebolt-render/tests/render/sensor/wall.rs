//! A tilted wall, and what sensors tell of it.

use eyebolt_geometry::{Distortion, PinholeCamera};
use eyebolt_render::{Exposure, Family, IdealView, Random, Sensor, Specimen};
use nalgebra::{Point2, Vector3};

/// The middle of a sensor's image.
pub fn crop(sensor: &Sensor, width: u32, height: u32) -> PinholeCamera {
    let f = sensor.camera().fx();
    let (cx, cy) = (0.5 * f64::from(width - 1), 0.5 * f64::from(height - 1));
    PinholeCamera::new(width, height, f, f, cx, cy, Distortion::None).unwrap()
}

/// A plane through the axis at `z_m`, its normal turned by `tilt_rad` about the vertical.
#[derive(Clone, Copy, Debug)]
pub struct Wall {
    pub z_m: f64,
    pub tilt_rad: f64,
}

impl Wall {
    pub fn facing(z_m: f64) -> Self {
        Self { z_m, tilt_rad: 0.0 }
    }

    fn normal(&self) -> Vector3<f64> {
        Vector3::new(self.tilt_rad.sin(), 0.0, -self.tilt_rad.cos())
    }

    pub fn view(&self, camera: &PinholeCamera) -> IdealView {
        let n = self.normal();
        let depth = |ray: Vector3<f64>| n.z * self.z_m / n.dot(&ray);
        let depth_m: Vec<f32> = rays(camera).map(|ray| depth(ray).max(0.0) as f32).collect();
        IdealView {
            width: camera.width() as usize,
            height: camera.height() as usize,
            surface: vec![0; depth_m.len()],
            normal_in_camera: vec![n.cast::<f32>().into(); depth_m.len()],
            depth_m,
        }
    }

    /// Angle between normal and ray of each pixel.
    pub fn angles_rad(&self, camera: &PinholeCamera) -> Vec<f64> {
        rays(camera).map(|ray| (-self.normal().dot(&ray) / ray.norm()).acos()).collect()
    }
}

fn rays(camera: &PinholeCamera) -> impl Iterator<Item = Vector3<f64>> + '_ {
    let pixels = (0..camera.height()).flat_map(|v| (0..camera.width()).map(move |u| (u, v)));
    pixels.map(|(u, v)| camera.ray(&Point2::new(f64::from(u), f64::from(v))).unwrap())
}

/// The specimen `seed` of the sensor before a wall that lights up in full. The image of the second
/// lens is not cropped.
pub fn exposure(sensor: &Sensor, camera: &PinholeCamera, wall: &Wall, seed: u64) -> Exposure {
    let mut sensor = *sensor;
    if let Family::Triangulation(figures) = &mut sensor.family {
        figures.overlap_only = false;
    }
    let everywhere = vec![true; camera.pixel_count()];
    let specimen = Specimen::new(Random::new(seed));
    sensor.expose(&wall.view(camera), camera, &everywhere, &specimen)
}

/// Errors of all depths that `specimens` of a sensor tell of a wall in `frames` frames each.
///
/// The wall stands at slightly different distances, so that no rounding favours it.
pub fn errors_m(
    sensor: &Sensor,
    camera: &PinholeCamera,
    wall: &Wall,
    [specimens, frames]: [u64; 2],
) -> Vec<f64> {
    let mut errors = Vec::new();
    for seed in 0..specimens {
        let aside = 1.0 + 0.03 * (seed as f64 / specimens as f64 - 0.5);
        let wall = Wall { z_m: wall.z_m * aside, ..*wall };
        let exposure = exposure(sensor, camera, &wall, seed);
        let truth = wall.view(camera).depth_m;
        for frame in 0..frames {
            let image = exposure.frame(Random::new(1_000_000 + seed).at(frame));
            let seen = image.depth_m().iter().zip(&truth).filter(|(z, _)| **z > 0.0);
            errors.extend(seen.map(|(z, truth)| f64::from(*z) - f64::from(*truth)));
        }
    }
    errors
}

pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

pub fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64).sqrt()
}

/// Asserts that `found` is within `share` of `published`.
pub fn assert_near(found: f64, published: f64, share: f64, what: &str) {
    let off = (found - published).abs() / published;
    assert!(off <= share, "{what}: found {found:.5}, published {published:.5}");
}
