//! Pictures of targets that were never printed.

use crate::noise::normal;
use eyebolt_geometry::{Camera, PinholeCamera, Transform};
use eyebolt_markers::{GreyImage, Marker, Target};
use nalgebra::{Point2, Point3};

/// How a picture is made.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// Brightness of black and white.
    pub black: f64,
    pub white: f64,
    /// Brightness of what is around the target.
    pub around: f64,
    /// Standard deviation of the blur, pixels.
    pub blur_px: f64,
    /// Standard deviation of the noise.
    pub noise: f64,
    pub seed: u64,
}

/// Samples along each side of a pixel.
const SAMPLES: usize = 3;

/// What `camera` sees of `target`, a white sheet with a margin of one cell around it.
pub fn picture(
    target: &Target,
    camera_from_marker: &Transform<Camera, Marker>,
    camera: &PinholeCamera,
    look: &Look,
) -> GreyImage {
    let (width, height) = (camera.width() as usize, camera.height() as usize);
    let mut values = vec![0.0; width * height];
    let marker_from_camera = camera_from_marker.inverse();
    let eye = marker_from_camera.point(&Point3::origin());
    for (at, value) in values.iter_mut().enumerate() {
        for sample in 0..SAMPLES * SAMPLES {
            let part = |i: usize| (i as f64 + 0.5) / SAMPLES as f64 - 0.5;
            let u = (at % width) as f64 + part(sample % SAMPLES);
            let v = (at / width) as f64 + part(sample / SAMPLES);
            let ray = marker_from_camera.direction(&camera.ray(&Point2::new(u, v)).unwrap());
            let far = -eye.z / ray.z;
            let point = eye + ray * far;
            let tone = if far > 0.0 { target.is_white_at(point.x, point.y) } else { None };
            *value += match tone {
                Some(true) => look.white,
                Some(false) => look.black,
                None => look.around,
            } / (SAMPLES * SAMPLES) as f64;
        }
    }
    let blurred = blurred(&blurred(&values, 1, width, look.blur_px), width, width, look.blur_px);
    let noisy = blurred.iter().enumerate().map(|(at, value)| {
        (value + look.noise * normal(look.seed, at as u64)).round().clamp(0.0, 255.0) as u8
    });
    GreyImage::new(width as u32, height as u32, noisy.collect()).unwrap()
}

/// Blurred along rows (`step` 1) or columns (`step` the width).
fn blurred(values: &[f64], step: usize, width: usize, sigma_px: f64) -> Vec<f64> {
    if sigma_px <= 0.0 {
        return values.to_vec();
    }
    let reach = (3.0 * sigma_px).ceil() as i64;
    let weight = |k: i64| (-0.5 * (k as f64 / sigma_px).powi(2)).exp();
    let all: f64 = (-reach..=reach).map(weight).sum();
    let height = values.len() / width;
    let each = values.iter().enumerate().map(|(at, _)| {
        let (u, v) = ((at % width) as i64, (at / width) as i64);
        let at = |k: i64| match step {
            1 => v as usize * width + (u + k).clamp(0, width as i64 - 1) as usize,
            _ => (v + k).clamp(0, height as i64 - 1) as usize * width + u as usize,
        };
        (-reach..=reach).map(|k| weight(k) * values[at(k)]).sum::<f64>() / all
    });
    each.collect()
}
