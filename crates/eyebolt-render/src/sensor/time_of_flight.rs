//! Depth from the time that modulated light takes there and back.

use super::exposure::{Exposure, Readout};
use super::field::Layers;
use super::figures::TimeOfFlight;
use super::multipath::multipath_m;
use super::specimen::Specimen;
use crate::view::IdealView;
use eyebolt_geometry::{PinholeCamera, RayTable};
use rayon::prelude::*;

/// Depths within this belong to one surface as far as mixing goes, metres.
const APART_M: f32 = 0.03;

/// By how much the least share, and the logarithm of the least signal, vary.
const SHARE_SPREAD: f32 = 0.05;
const SIGNAL_SPREAD: f32 = 0.1;

/// Distance in the image, as a share of its width, and in depth, metres, at which the systematic
/// error is half correlated. That it goes up and down with depth is known (the wave is not a sine:
/// Lindner and Kolb, *Lateral and depth calibration of PMD-distance sensors*, ISVC 2006); these
/// lengths are assumed.
const SYSTEMATIC_SHARE: f32 = 1.0 / 3.0;
const SYSTEMATIC_M: f32 = 0.4;

/// What each pixel gets of the light.
struct Light {
    size: [usize; 2],
    depth_m: Vec<f32>,
    /// 0 where nothing is seen.
    signal: Vec<f32>,
}

/// What `specimen` with `figures` measures of `view` of `camera`.
pub fn expose(
    figures: &TimeOfFlight,
    view: &IdealView,
    camera: &PinholeCamera,
    specimen: &Specimen,
) -> Exposure {
    let size = [view.width, view.height];
    let light = Light::new(view, camera);
    let kernel = kernel(figures.blur_px);
    let pixels = (0..view.depth_m.len()).into_par_iter();
    let (mixed_m, share): (Vec<f32>, Vec<f32>) = pixels.map(|at| light.mix(at, &kernel)).unzip();
    let late_m = multipath_m(view, camera, figures.reflectivity, figures.wavelength_m);
    let depth_m: Vec<f32> =
        mixed_m.iter().zip(late_m).map(|(z, late)| lengthened(*z, late, specimen)).collect();
    let confidence = share.iter().zip(&light.signal).map(|(share, signal)| {
        let share = (share - figures.least_share as f32) / SHARE_SPREAD;
        share.min((signal / figures.least_signal as f32).ln() / SIGNAL_SPREAD)
    });
    let sigma = light.signal.iter().map(|signal| figures.random_m as f32 / signal.max(1e-6));
    Exposure {
        size,
        readout: Readout::Depth,
        range_m: [0.0, f32::INFINITY],
        confidence: confidence.collect(),
        sigma: sigma.collect(),
        value: with_systematic(depth_m, size, figures, specimen),
        lateral: None,
        half_px: 0.0,
    }
}

/// What `specimen` makes of depth `z` whose light comes late, metres; nothing remains nothing.
fn lengthened(z: f32, late_m: f32, specimen: &Specimen) -> f32 {
    if z > 0.0 { specimen.depth_m(z + late_m) } else { 0.0 }
}

impl Light {
    fn new(view: &IdealView, camera: &PinholeCamera) -> Self {
        let rays = RayTable::new(camera);
        let signal = |(at, [x, y]): (usize, &[f32; 2])| {
            let (z, [nx, ny, nz]) = (view.depth_m[at], view.normal_in_camera[at]);
            let squared = x * x + y * y + 1.0;
            let cosine = -(nx * x + ny * y + nz) / squared.sqrt();
            if z > 0.0 { cosine.max(0.0) / (z * z * squared) } else { 0.0 }
        };
        Self {
            size: [view.width, view.height],
            depth_m: view.depth_m.clone(),
            signal: rays.rays().par_iter().enumerate().map(signal).collect(),
        }
    }

    /// Depth that pixel `at` tells of what it mixes, and the share of the signal that comes from
    /// the surface that gives most.
    ///
    /// The waves that two surfaces send back add up; their sum is between them, weighted by signal,
    /// as long as their distance is small in wavelengths (Lefloch et al., *Technical foundation and
    /// calibration methods for time-of-flight cameras*, 2013).
    fn mix(&self, at: usize, kernel: &[f32]) -> (f32, f32) {
        let [width, height] = self.size;
        let (own, reach) = (self.depth_m[at], kernel.len() / 2);
        if own == 0.0 {
            return (0.0, 0.0);
        }
        let (mut sum, mut weights, mut nearer, mut farther) = (0.0, 0.0, 0.0, 0.0);
        for (down, v) in kernel.iter().zip(at / width..) {
            let Some(v) = v.checked_sub(reach).filter(|v| *v < height) else { continue };
            for (across, u) in kernel.iter().zip(at % width..) {
                let Some(u) = u.checked_sub(reach).filter(|u| *u < width) else { continue };
                let other = v * width + u;
                let (z, weight) = (self.depth_m[other], down * across * self.signal[other]);
                sum += weight * z;
                weights += weight;
                nearer += if z < own - APART_M { weight } else { 0.0 };
                farther += if z > own + APART_M { weight } else { 0.0 };
            }
        }
        if weights == 0.0 {
            return (own, 0.0);
        }
        if nearer + farther == 0.0 {
            // Of one surface, the middle is the pixel's own depth: on a tilted one the nearer half
            // is brighter, but the camera's calibration has seen to that.
            return (own, 1.0);
        }
        let most = f32::max(weights - nearer - farther, f32::max(nearer, farther));
        (sum / weights, most / weights)
    }
}

/// Weights along an axis, sum 1.
fn kernel(blur_px: f64) -> Vec<f32> {
    let reach = (2.5 * blur_px).ceil() as i32;
    let weight = |x: i32| (-0.5 * (f64::from(x) / blur_px.max(1e-3)).powi(2)).exp();
    let sum: f64 = (-reach..=reach).map(weight).sum();
    (-reach..=reach).map(|x| (weight(x) / sum) as f32).collect()
}

fn with_systematic(
    mut depth_m: Vec<f32>,
    size: [usize; 2],
    figures: &TimeOfFlight,
    specimen: &Specimen,
) -> Vec<f32> {
    let half_px = SYSTEMATIC_SHARE * size[0] as f32;
    let layers = Layers::new(specimen.random.at(0), size, half_px, SYSTEMATIC_M, &depth_m);
    let (floor, growth) = (figures.systematic_m as f32, figures.systematic_growth as f32);
    let seen = depth_m.par_iter_mut().enumerate().filter(|(_, z)| **z > 0.0);
    seen.for_each(|(at, z)| {
        *z += (floor + growth * *z) * layers.at(at % size[0], at / size[0], *z);
    });
    depth_m
}
